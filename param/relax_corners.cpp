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
constexpr int kMostRings = 24;      // of `unwind`
constexpr double kRoundRim = 0.18;  // radius of a rim that is spread along a circle, in base edges

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
  Relaxation(const Atlas& atlas, const std::vector<std::array<double, 2>>& weights, double radius, int base_vertex)
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

  /// The same for the vertices within so many rings of the corner, whatever their distance in the charts: a corner that lost
  /// a full turn to a vertex near by gets it back once the rings reach round that vertex. Where the rim is no round curve it
  /// is spread along a circle by arc length.
  bool unwind(int rings, bool round_rim, Move& move) {
    if (!gather_rings(rings) || !lift() || (round_rim && !spread_rim()) || !solve() || !embedded()) return false;
    const int nearest = fan_.boundary ? 0 : nearest_to_center();
    if (!draw_to_center(nearest) || !embedded() || !upright_in_plane(nearest)) return false;
    move.new_corner = vertices_[nearest].vertex;
    place(nearest, move);
    return closed(move);
  }

  /// Whether the region holds one of the marked vertices.
  bool holds(const std::vector<char>& marked) {
    gather();
    const bool found = std::any_of(vertices_.begin(), vertices_.end(),
                                   [&](const DiscVertex& v) { return v.inside && marked[v.vertex]; });
    vertices_.clear();
    index_.clear();
    return found;
  }

 private:
  bool collect();
  void gather();
  bool gather_rings(int rings);
  bool lift();
  bool spread_rim();
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
  const std::vector<std::array<double, 2>>& weights_;
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

/// False where the rings meet another corner, or a boundary and the corner is inside.
bool Relaxation::gather_rings(int rings) {
  vertices_.assign(1, {corner_, !fan_.boundary, {}, 0.0, 0.0});
  index_ = {{corner_, 0}};
  std::vector<int> ring{0};
  bool good = true;
  for (std::size_t i = 0; i < vertices_.size() && good; ++i) {
    if (ring[i] == rings) continue;
    surface().for_each_neighbour(vertices_[i].vertex, [&](int w, int, bool) {
      if (!index_.emplace(w, static_cast<int>(vertices_.size())).second) return;
      ring.push_back(ring[i] + 1);
      const bool near = ring.back() < rings, border = surface().halfedges.boundary_vertex(w);
      good = good && !(near && (atlas_.corner[w] >= 0 || (border && !fan_.boundary)));
      vertices_.push_back({w, near && !border, {}, 0.0, 0.0});
    });
  }
  return good;
}

/// Places the rim on a circle by arc length, turned to agree with where it lies; false where the rim is no simple loop.
bool Relaxation::spread_rim() {
  if (fan_.boundary) return false;
  std::unordered_map<int, int> next;
  int rim_size = 0;
  for (const DiscVertex& v : vertices_) {
    if (!v.inside) {
      ++rim_size;
      continue;
    }
    const int start = surface().halfedges.outgoing[v.vertex];
    int h = start;
    do {
      const int link = Halfedges::next(h);
      const int a = index_.at(surface().halfedges.from(link)), b = index_.at(surface().halfedges.to(link));
      if (!vertices_[a].inside && !vertices_[b].inside && !next.emplace(a, b).second) return false;
      h = surface().halfedges.rotate_ccw(h);
    } while (h != start);
  }
  if (next.empty()) return false;
  std::vector<int> loop{next.begin()->first};
  for (const auto& [a, b] : next) loop[0] = std::min(loop[0], a);
  std::vector<double> length{0.0};
  const auto& positions = surface().mesh.positions;
  do {
    const auto at = next.find(loop.back());
    if (at == next.end() || static_cast<int>(loop.size()) > rim_size) return false;
    length.push_back(length.back() + (positions[vertices_[at->second].vertex] - positions[vertices_[loop.back()].vertex]).norm());
    loop.push_back(at->second);
  } while (loop.back() != loop.front());
  loop.pop_back();
  if (static_cast<int>(loop.size()) != rim_size || !(length.back() > 0.0)) return false;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  Complex agreement = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    agreement += std::polar(1.0, vertices_[loop[i]].angle * power_ - kTurn * length[i] / length.back());
  const double start = std::arg(agreement), rim_radius = std::pow(radius_, power_);
  for (std::size_t i = 0; i < loop.size(); ++i)
    vertices_[loop[i]].disc = std::polar(rim_radius, start + kTurn * length[i] / length.back());
  return true;
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

std::vector<char> folded_vertices(const Atlas& atlas) {
  const Folds folds = find_folds(atlas);
  std::vector<char> marked(atlas.patch.size(), 0);
  for (int f : folds.faces)
    for (int v : atlas.surface->mesh.faces[f]) marked[v] = 1;
  for (int v : folds.vertices) marked[v] = 1;
  return marked;
}

/// Computes every corner's move in parallel, then makes those that do not overlap, in the order of the base vertices.
template <class Compute>
int move_corners(Atlas& atlas, Compute&& compute) {
  std::vector<Move> moves(atlas.fans.size());
  parallel_for(moves.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      if (compute(static_cast<int>(b), moves[b])) moves[b].base_vertex = static_cast<int>(b);
  });
  int moved = 0;
  std::vector<char> inside(atlas.surface->mesh.positions.size(), 0), rim(inside);
  for (const Move& move : moves) {
    if (move.base_vertex < 0) continue;
    // Where edges are long two regions can overlap: the later corner waits for the next round.
    const bool overlap =
        std::any_of(move.rim.begin(), move.rim.end(), [&](int v) { return inside[v]; }) ||
        std::any_of(move.places.begin(), move.places.end(),
                    [&](const NewPlace& place) { return inside[place.vertex] || rim[place.vertex]; });
    if (overlap) continue;
    for (int v : move.rim) rim[v] = 1;
    for (const NewPlace& place : move.places) inside[place.vertex] = 1;
    ++moved;
    atlas.corner[atlas.base.vertices[move.base_vertex]] = -1;
    atlas.base.vertices[move.base_vertex] = move.new_corner;
    atlas.corner[move.new_corner] = move.base_vertex;
    for (const NewPlace& place : move.places) {
      atlas.patch[place.vertex] = place.chart;
      atlas.position[place.vertex] = place.position;
    }
    for (const NewTransition& t : move.transitions) atlas.transition[t.edge] = t.transition;
  }
  return moved;
}

}  // namespace

int relax_corners(Atlas& atlas, const std::vector<std::array<double, 2>>& weights, double radius) {
  return move_corners(atlas, [&](int b, Move& move) { return Relaxation(atlas, weights, radius, b).run(move); });
}

int unwind_corners(Atlas& atlas, const std::vector<std::array<double, 2>>& weights) {
  return move_corners(atlas, [&](int b, Move& move) {
    if (wound_rightly(atlas, atlas.base.vertices[b])) return false;
    for (int rings = 2; rings <= kMostRings; ++rings)
      for (bool round_rim : {false, true}) {
        move = {};
        if (Relaxation(atlas, weights, kRoundRim, b).unwind(rings, round_rim, move)) return true;
      }
    return false;
  });
}

int settle_corners(Atlas& atlas, const std::vector<std::array<double, 2>>& weights, double radius) {
  const std::vector<char> marked = folded_vertices(atlas);
  return move_corners(atlas, [&](int b, Move& move) {
    Relaxation relaxation(atlas, weights, radius, b);
    return relaxation.holds(marked) && relaxation.run(move);
  });
}

}  // namespace gsp
