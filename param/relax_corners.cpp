#include "param/relax_corners.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <unordered_map>

#include "mesh/parallel.h"
#include "param/folds.h"
#include "param/sparse_solver.h"

namespace gsp {

namespace {

constexpr double kSector = std::numbers::pi / 3.0;
constexpr double kShrink[] = {1.0, 0.6, 0.36};  // of the radius, where a larger region would fold

/// One vertex of the region around a corner, seen from the corner.
struct DiscVertex {
  int vertex;
  bool inside;        ///< solved for; the others form the held rim
  Transition develop; ///< its chart -> the plane developed about the corner
  double angle;       ///< in that plane, continued without jumps from the first vertex (in (-∞, ∞))
  Complex disc;       ///< position in the disc
};

struct NewPlace {
  int vertex;
  int chart;
  Complex position;
};
struct NewTransition {
  int edge;
  Transition transition;
};

/// What a corner's relaxation changes; applied after all corners are computed.
struct Move {
  int base_vertex = -1;
  int new_corner = -1;
  std::vector<NewPlace> places;
  std::vector<NewTransition> transitions;
  std::vector<int> rim;
};

class Relaxation {
 public:
  Relaxation(const Atlas& atlas, const EdgeWeights& weights, double radius, int base_vertex)
      : atlas_(atlas),
        weights_(weights),
        radius_(radius),
        fan_(atlas.fans[base_vertex]),
        corner_(atlas.base.vertices[base_vertex]),
        cone_(fan_.valence() * kSector),
        power_((fan_.boundary ? 3.0 : 6.0) / fan_.valence()) {}

  /// Lays the whole region out from the disc, with the vertex nearest 0 drawn onto it. Where that would leave a fold, only
  /// moves the corner. False where the region is no disc or nothing would change for the better.
  bool run(Move& move) {
    if (!collect() || !solve() || !embedded()) return false;
    const int nearest = fan_.boundary ? 0 : nearest_to_center();
    const std::vector<DiscVertex> solved = vertices_;
    if (!draw_to_center(nearest) || !embedded() || !upright_in_plane(nearest)) {
      if (nearest == 0) return false;
      vertices_ = solved;
    }
    move.new_corner = vertices_[nearest].vertex;
    place(nearest, move);
    return closed(move);
  }

 private:
  bool collect();
  void gather();
  bool lift();
  void straighten_border();
  bool solve();
  bool embedded() const;
  int nearest_to_center() const;
  bool draw_to_center(int nearest);
  bool upright_in_plane(int nearest) const;
  void place(int nearest, Move& move);
  bool closed(const Move& move) const;

  const Surface& surface() const { return *atlas_.surface; }
  Complex to_disc(double radius, double angle) const {
    return std::polar(std::pow(radius, power_), angle * power_);
  }

  const Atlas& atlas_;
  const EdgeWeights& weights_;
  const double radius_;
  const BaseFan& fan_;
  const int corner_;
  const double cone_;   ///< angle around the corner
  const double power_;  ///< of the map to the disc, or to the half disc of a boundary corner
  std::vector<DiscVertex> vertices_;  ///< [0] is the corner
  std::unordered_map<int, int> index_;
};

bool Relaxation::collect() {
  gather();
  return vertices_.size() > 1 && lift();
}

/// The corner, the vertices within the radius that are connected to it, and the rim around them.
void Relaxation::gather() {
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
bool Relaxation::lift() {
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
    const double middle = (s + 0.5) * kSector;
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
    const DiscVertex& v = vertices_[i];
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
    const DiscVertex& from = vertices_[next.from];
    DiscVertex& v = vertices_[next.index];
    const Complex from_plane = from.develop.apply(atlas_.position[from.vertex]);
    v.develop = from.develop * atlas_.towards(next.edge, next.forward);
    v.angle = from.angle + std::arg(v.develop.apply(atlas_.position[v.vertex]) / from_plane);
    v.disc = to_disc(next.radius, v.angle);
    visit(next.index);
  }
  if (fan_.boundary) straighten_border();
  return reached == vertices_.size();
}

/// The boundary vertices of a boundary corner's region lie on the two straight sides of its sector, whatever the folds say.
void Relaxation::straighten_border() {
  const int last = fan_.valence() - 1;
  for (std::size_t i = 1; i < vertices_.size(); ++i) {
    DiscVertex& v = vertices_[i];
    const int s = fan_.find(atlas_.patch[v.vertex]);
    if (!surface().halfedges.boundary_vertex(v.vertex) || (s != 0 && s != last)) continue;
    for (int side : {0, last}) {
      const double angle = side == 0 ? 0.0 : cone_;
      const Complex turned = fan_.develop(side).apply(atlas_.position[v.vertex]) * std::polar(1.0, -angle);
      if (s != side || std::abs(turned.imag()) > 1e-9 || turned.real() <= 0.0) continue;
      v.develop = fan_.develop(side);
      v.angle = angle;
      v.disc = to_disc(turned.real(), angle);
    }
  }
}

bool Relaxation::solve() {
  std::vector<int> row(vertices_.size(), -1);
  int unknowns = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (vertices_[i].inside) row[i] = unknowns++;
  if (unknowns == static_cast<int>(vertices_.size())) return false;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (row[i] < 0) continue;
    double sum = 0.0;
    surface().for_each_neighbour(vertices_[i].vertex, [&](int w, int edge, bool forward) {
      const double c = weights_[edge][forward ? 0 : 1];
      sum += c;
      const int j = index_.at(w);
      if (row[j] >= 0) {
        entries.emplace_back(row[i], row[j], -c);
      } else {
        right(row[i], 0) += c * vertices_[j].disc.real();
        right(row[i], 1) += c * vertices_[j].disc.imag();
      }
    });
    entries.emplace_back(row[i], row[i], sum);
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixX2d x;
  if (!solve_sparse(matrix, right, x)) return false;
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (row[i] >= 0) vertices_[i].disc = {x(row[i], 0), x(row[i], 1)};
  return true;
}

bool Relaxation::embedded() const {
  for (const DiscVertex& v : vertices_) {
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

int Relaxation::nearest_to_center() const {
  int nearest = 0;
  for (std::size_t i = 1; i < vertices_.size(); ++i)
    if (vertices_[i].inside && std::norm(vertices_[i].disc) < std::norm(vertices_[nearest].disc))
      nearest = static_cast<int>(i);
  return nearest;
}

/// Moves the disc's middle so that the vertex lies at 0: a shift that fades out smoothly toward the rim.
bool Relaxation::draw_to_center(int nearest) {
  double rim = 1e300;
  for (const DiscVertex& v : vertices_)
    if (!v.inside && v.vertex != corner_) rim = std::min(rim, std::abs(v.disc));
  const Complex shift = vertices_[nearest].disc;
  if (std::abs(shift) > 0.4 * rim) return false;
  for (DiscVertex& v : vertices_) {
    if (!v.inside) continue;
    const double r = std::abs(v.disc - shift) / rim;
    if (r < 1.0) v.disc -= shift * (1.0 - r * r) * (1.0 - r * r);
  }
  vertices_[nearest].disc = 0.0;
  return true;
}

/// Whether every face that the region moves has positive area once the disc is taken back to the charts by z^(k/6).
bool Relaxation::upright_in_plane(int nearest) const {
  const double power = 1.0 / power_;
  for (const DiscVertex& v : vertices_) {
    if (!v.inside) continue;
    const int start = surface().halfedges.outgoing[v.vertex];
    int h = start;
    do {
      const int corners[3] = {index_.at(v.vertex), index_.at(surface().halfedges.to(h)),
                              index_.at(surface().halfedges.to(Halfedges::next(h)))};
      const int first = corners[0] == nearest ? 1 : 0;
      Complex plane[3];
      for (int k = 0; k < 3; ++k) {
        if (corners[k] == nearest) continue;
        const Complex z = vertices_[corners[k]].disc;
        plane[k] = std::polar(std::pow(std::abs(z), power), std::arg(z / vertices_[corners[first]].disc) * power);
      }
      if (!upright(plane[0], plane[1], plane[2])) return false;
      h = surface().halfedges.rotate_ccw(h);
    } while (h != start);
  }
  return true;
}

void Relaxation::place(int nearest, Move& move) {
  const double power = 1.0 / power_;
  vertices_[0].develop = fan_.develop(fan_.find(atlas_.patch[corner_]));
  // New frames of all inside vertices; the rim keeps its own.
  for (const DiscVertex& v : vertices_)
    if (!v.inside) move.rim.push_back(v.vertex);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    DiscVertex& v = vertices_[i];
    if (!v.inside) continue;
    int sector = 0;
    Complex plane = 0.0;
    if (static_cast<int>(i) != nearest) {
      v.angle = std::arg(v.disc) * power;
      sector = static_cast<int>(std::floor(v.angle / kSector));
      plane = std::polar(std::pow(std::abs(v.disc), power), v.angle);
    }
    v.develop = fan_.develop(sector);
    const BaseFan::Sector& s = fan_.sector(sector);
    move.places.push_back({v.vertex, s.face,
                           static_cast<int>(i) == nearest ? kChartCorners[s.corner].value()
                                                          : v.develop.inverse().apply(plane)});
  }
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const DiscVertex& v = vertices_[i];
    if (!v.inside) continue;
    surface().for_each_neighbour(v.vertex, [&](int w, int edge, bool forward) {
      const int j = index_.at(w);
      const DiscVertex& other = vertices_[j];
      if (other.inside && j < static_cast<int>(i)) return;
      Transition to_other_plane = other.develop;
      if (static_cast<int>(i) != nearest && j != nearest) {
        // The edge is straight in the disc: it passes the corner on one side, which says by how many full turns the two
        // planes differ.
        const double along = v.angle + std::arg(other.disc / v.disc) * power;
        const int turns = fan_.boundary ? 0 : static_cast<int>(std::lround((along - other.angle) / cone_));
        const int sixths = turns * fan_.valence();
        to_other_plane = Transition{((sixths % 6) + 6) % 6, {}} * to_other_plane;
      }
      const Transition t = v.develop.inverse() * to_other_plane;
      move.transitions.push_back({edge, forward ? t : t.inverse()});
    });
  }
}

/// Whether the new transitions compose to the identity around every face of the region, which the lifted rim implies
/// unless the old map was folded there too.
bool Relaxation::closed(const Move& move) const {
  std::unordered_map<int, Transition> changed;
  for (const NewTransition& t : move.transitions) changed.emplace(t.edge, t.transition);
  const auto across = [&](int h) {
    const int edge = surface().edge_of[h];
    const auto at = changed.find(edge);
    const Transition t = at == changed.end() ? atlas_.transition[edge] : at->second;
    return surface().edge_halfedge[edge] == h ? t : t.inverse();
  };
  const auto is_corner = [&](int v) { return v == move.new_corner || (v != corner_ && atlas_.corner[v] >= 0); };
  for (const DiscVertex& v : vertices_) {
    if (!v.inside) continue;
    const int start = surface().halfedges.outgoing[v.vertex];
    int h = start;
    do {
      const int a = surface().halfedges.to(h), b = surface().halfedges.to(Halfedges::next(h));
      const Transition forth = across(h), beside = across(Halfedges::next(h)), back = across(Halfedges::prev(h));
      if (!is_corner(v.vertex)) {
        // At a corner transitions hold up to turns about it, so only where it lies can be compared.
        const Transition round = forth * beside;
        const Transition direct = back.inverse();
        if (!is_corner(a) && !is_corner(b) && !(round == direct)) return false;
        if (!is_corner(a) && is_corner(b) && b != move.new_corner &&
            std::abs(round.apply(atlas_.position[b]) - direct.apply(atlas_.position[b])) > 1e-6)
          return false;
        if (is_corner(a) && !is_corner(b) && a != move.new_corner &&
            std::abs((direct * beside.inverse()).apply(atlas_.position[a]) - forth.apply(atlas_.position[a])) > 1e-6)
          return false;
      }
      h = surface().halfedges.rotate_ccw(h);
    } while (h != start);
  }
  return true;
}

/// Makes the move; a second call with the same values takes it back.
void exchange(Atlas& atlas, Move& move) {
  int& corner = atlas.base.vertices[move.base_vertex];
  atlas.corner[corner] = -1;
  std::swap(corner, move.new_corner);
  atlas.corner[corner] = move.base_vertex;
  for (NewPlace& place : move.places) {
    std::swap(atlas.patch[place.vertex], place.chart);
    std::swap(atlas.position[place.vertex], place.position);
  }
  for (NewTransition& t : move.transitions) std::swap(atlas.transition[t.edge], t.transition);
}

bool free_of_folds(const Atlas& atlas, const Move& move) {
  for (const NewPlace& place : move.places)
    if (local_map(atlas, place.vertex) != LocalMap::Injective) return false;
  return std::all_of(move.rim.begin(), move.rim.end(), [&](int v) { return local_map(atlas, v) == LocalMap::Injective; });
}

}  // namespace

int relax_corners(Atlas& atlas, const EdgeWeights& weights, double radius, Folding folding) {
  int moved = 0;
  std::vector<char> done(atlas.fans.size(), 0);
  std::vector<char> inside(atlas.surface->mesh.positions.size(), 0), rim(inside);
  for (double shrink : kShrink) {
    std::vector<Move> moves(atlas.fans.size());
    parallel_for(moves.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b)
        if (!done[b] && Relaxation(atlas, weights, shrink * radius, static_cast<int>(b)).run(moves[b]))
          moves[b].base_vertex = static_cast<int>(b);
    });
    for (Move& move : moves) {
      if (move.base_vertex < 0) continue;
      // Where edges are long two regions can overlap: the later corner waits for the next round.
      const bool overlap =
          std::any_of(move.rim.begin(), move.rim.end(), [&](int v) { return inside[v]; }) ||
          std::any_of(move.places.begin(), move.places.end(),
                      [&](const NewPlace& place) { return inside[place.vertex] || rim[place.vertex]; });
      if (overlap) continue;
      exchange(atlas, move);
      if (folding == Folding::Refused && !free_of_folds(atlas, move)) {
        exchange(atlas, move);
        continue;
      }
      for (int v : move.rim) rim[v] = 1;
      for (const NewPlace& place : move.places) inside[place.vertex] = 1;
      done[move.base_vertex] = 1;
      ++moved;
    }
  }
  return moved;
}

}  // namespace gsp
