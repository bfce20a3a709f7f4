#include "param/corners/corner_disc.h"

#include <algorithm>
#include <queue>

#include "param/atlas/folds.h"
#include "param/linear/sparse_solver.h"
#include "param/map/tolerances.h"

namespace gsp {

CornerDisc::CornerDisc(const Atlas& atlas, double radius, int base_vertex)
    : atlas_(atlas),
      radius_(radius),
      fan_(atlas.fans[base_vertex]),
      corner_(atlas.base.vertices[base_vertex]),
      power_((fan_.boundary ? 3.0 : 6.0) / fan_.valence()) {}

bool CornerDisc::collect() {
  gather();
  return vertices_.size() > 1 && lift();
}

void CornerDisc::gather() {
  const auto add = [&](int v, bool inside) {
    if (!index_.emplace(v, static_cast<int>(vertices_.size())).second) return;
    vertices_.push_back({v, inside, {}, 0.0, 0.0});
  };
  add(corner_, !fan_.boundary);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (i > 0 && !vertices_[i].inside) continue;
    surface().for_each_neighbour(vertices_[i].vertex, [&](int w, int, bool) {
      const int s = fan_.find(atlas_.patch[w]);
      add(w, s >= 0 && atlas_.corner[w] < 0 && !surface().halfedges.boundary_vertex(w) &&
                 std::abs(fan_.develop(s).apply(atlas_.position[w])) < radius_);
    });
  }
}

/// Develops the region about the corner. The map may be folded next to the corner, so the plane is continued from the
/// outermost vertices inwards: a fold cannot put a wrong turn into the rim, which is all that the new map takes over.
bool CornerDisc::lift() {
  int seed = -1;
  double farthest = -1.0;
  for (std::size_t i = 1; i < vertices_.size(); ++i) {
    const int s = fan_.find(atlas_.patch[vertices_[i].vertex]);
    if (s < 0 || atlas_.corner[vertices_[i].vertex] >= 0) continue;
    const Transition develop = fan_.develop(s);
    const Complex plane = develop.apply(atlas_.position[vertices_[i].vertex]);
    if (std::abs(plane) <= farthest) continue;
    farthest = std::abs(plane);
    seed = static_cast<int>(i);
    const double middle = (s + 0.5) * kSectorAngle;
    vertices_[i].develop = develop;
    vertices_[i].angle = middle + std::arg(plane * std::polar(1.0, -middle));
  }
  if (seed < 0) return false;

  struct Next {
    double radius;
    int index, from, edge;
    bool forward;
    bool operator<(const Next& other) const {
      return radius != other.radius ? radius < other.radius : index > other.index;
    }
  };
  std::priority_queue<Next> queue;
  std::vector<char> done(vertices_.size(), 0);
  done[0] = 1;
  const auto visit = [&](int i) {
    done[i] = 1;
    const Vertex& v = vertices_[i];
    if (atlas_.corner[v.vertex] >= 0) return;  // transitions at a corner hold up to turns only
    surface().for_each_neighbour(v.vertex, [&](int w, int edge, bool forward) {
      const auto at = index_.find(w);
      if (at == index_.end() || done[at->second]) return;
      const Complex plane = (v.develop * atlas_.towards(edge, forward)).apply(atlas_.position[w]);
      queue.push({std::abs(plane), at->second, i, edge, forward});
    });
  };
  vertices_[seed].disc = to_disc(farthest, vertices_[seed].angle);
  visit(seed);
  std::size_t reached = 2;
  while (!queue.empty()) {
    const Next next = queue.top();
    queue.pop();
    if (done[next.index]) continue;
    ++reached;
    const Vertex& from = vertices_[next.from];
    Vertex& v = vertices_[next.index];
    const Complex from_plane = from.develop.apply(atlas_.position[from.vertex]);
    v.develop = from.develop * atlas_.towards(next.edge, next.forward);
    v.angle = from.angle + std::arg(v.develop.apply(atlas_.position[v.vertex]) / from_plane);
    v.disc = to_disc(next.radius, v.angle);
    visit(next.index);
  }
  if (fan_.boundary) straighten_border();
  return reached == vertices_.size();
}

/// The boundary vertices of a boundary corner's region lie on the two straight sides of its sector, whatever the folds
/// say.
void CornerDisc::straighten_border() {
  const int last = fan_.valence() - 1;
  for (std::size_t i = 1; i < vertices_.size(); ++i) {
    Vertex& v = vertices_[i];
    const int s = fan_.find(atlas_.patch[v.vertex]);
    if (!surface().halfedges.boundary_vertex(v.vertex) || (s != 0 && s != last)) continue;
    for (int side : {0, last}) {
      const double angle = side == 0 ? 0.0 : fan_.valence() * kSectorAngle;
      const Complex turned = fan_.develop(side).apply(atlas_.position[v.vertex]) * std::polar(1.0, -angle);
      if (s != side || std::abs(turned.imag()) > tolerance::kSamePlace || turned.real() <= 0.0) continue;
      v.develop = fan_.develop(side);
      v.angle = angle;
      v.disc = to_disc(turned.real(), angle);
    }
  }
}

bool CornerDisc::solve(const LinearWeights& weights) {
  std::vector<int> row(vertices_.size(), -1);
  int unknowns = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (vertices_[i].inside) row[i] = unknowns++;
  if (unknowns == static_cast<int>(vertices_.size())) return false;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
  const auto add = [&](int i, int j, double weight) {
    if (row[i] < 0) return;
    entries.emplace_back(row[i], row[i], weight);
    if (row[j] >= 0) {
      entries.emplace_back(row[i], row[j], -weight);
    } else {
      right(row[i], 0) += weight * vertices_[j].disc.real();
      right(row[i], 1) += weight * vertices_[j].disc.imag();
    }
  };
  for (const Spring& s : weights.springs(atlas_, faces())) {
    const int i = index_.at(s.start), j = index_.at(s.end);
    add(i, j, s.at_start);
    add(j, i, s.at_end);
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixX2d x;
  if (!solve_sparse(matrix, right, x)) return false;
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (row[i] >= 0) vertices_[i].disc = {x(row[i], 0), x(row[i], 1)};
  return true;
}

bool CornerDisc::embedded() const {
  for (const Vertex& v : vertices_) {
    if (!v.inside) continue;
    const int start = surface().halfedges.outgoing[v.vertex];
    for (int h = start;;) {
      const Complex a = vertices_[index_.at(surface().halfedges.to(h))].disc;
      const Complex b = vertices_[index_.at(surface().halfedges.to(Halfedges::next(h)))].disc;
      if (chart_area(v.disc, a, b) <= 0.0) return false;
      h = surface().halfedges.rotate_ccw(h);
      if (h == start) break;
    }
  }
  return true;
}

int CornerDisc::nearest_to(Complex place) const {
  int nearest = 0;
  for (std::size_t i = 1; i < vertices_.size(); ++i) {
    const Vertex& v = vertices_[i];
    if (v.inside && v.vertex < atlas_.first_added &&
        std::norm(v.disc - place) < std::norm(vertices_[nearest].disc - place))
      nearest = static_cast<int>(i);
  }
  return nearest;
}

double CornerDisc::rim() const {
  double rim = 1e300;
  for (const Vertex& v : vertices_)
    if (!v.inside && v.vertex != corner_) rim = std::min(rim, std::abs(v.disc));
  return rim;
}

bool CornerDisc::draw_to_center(int index) {
  const double rim = this->rim();
  const Complex shift = vertices_[index].disc;
  if (std::abs(shift) > 0.4 * rim) return false;
  for (Vertex& v : vertices_) {
    if (!v.inside) continue;
    const double r = std::abs(v.disc - shift) / rim;
    if (r < 1.0) v.disc -= shift * (1.0 - r * r) * (1.0 - r * r);
  }
  vertices_[index].disc = 0.0;
  return true;
}

std::vector<int> CornerDisc::faces() const {
  std::vector<int> inside;
  for (const Vertex& v : vertices_)
    if (v.inside) inside.push_back(v.vertex);
  return faces_around(surface(), inside);
}

std::array<Complex, 3> CornerDisc::in_plane(int face, int center) const {
  const Triangle& t = surface().mesh.faces[face];
  const int corners[3] = {index_.at(t[0]), index_.at(t[1]), index_.at(t[2])};
  const int first = corners[0] == center ? 1 : 0;
  std::array<Complex, 3> plane;
  for (int k = 0; k < 3; ++k) {
    if (corners[k] == center) continue;
    const Complex z = vertices_[corners[k]].disc;
    plane[k] = std::polar(std::pow(std::abs(z), 1.0 / power_), std::arg(z / vertices_[corners[first]].disc) / power_);
  }
  return plane;
}

bool CornerDisc::upright_in_plane(int center) const {
  const std::vector<int> all = faces();
  return std::all_of(all.begin(), all.end(), [&](int face) {
    const auto [a, b, c] = in_plane(face, center);
    return upright(a, b, c);
  });
}

}  // namespace gsp
