#include "param/baselines/maps_smoothing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "param/atlas/folds.h"
#include "param/baselines/smoothed_domain.h"
#include "param/energy/untangle.h"
#include "param/removal/flatten.h"

namespace gsp {

namespace {

constexpr int kMostLevels = 8;
constexpr double kRounding = 1e-9;  // of a weight
constexpr int kRepairRings = 16;    // of vertices around a fold that may move once more
constexpr int kMostPieces = 64;     // base faces that one dyadic triangle reaches

using FaceWeights = std::array<double, 3>;

/// Where a vertex is in the smoothed domain, as far as is known.
struct Found {
  double least = -1e300;  ///< weight of the triangle's corners
  int face = -1;
  Transition change;  ///< from the vertex's chart to that of the face
  Complex position;
};

/// The vertices in one base face by cells of their weights for corners 1 and 2.
class FaceCells {
 public:
  void add(int vertex, const FaceWeights& weights) { all_.push_back({vertex, weights}); }
  void sort() {
    side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(all_.size()))));
    cells_.resize(static_cast<std::size_t>(side_) * side_);
    for (std::size_t k = 0; k < all_.size(); ++k)
      cells_[static_cast<std::size_t>(cell(all_[k].weights[2])) * side_ + cell(all_[k].weights[1])].push_back(
          static_cast<int>(k));
  }
  /// Calls visit(vertex, weights) for those in a box of weights, and some around it.
  template <class Visit>
  void for_each_within(const std::array<FaceWeights, 3>& corners, Visit&& visit) const {
    if (all_.empty()) return;
    const auto range = [&](int k) {
      const auto [low, high] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
      return std::pair(cell(low - kRounding), cell(high + kRounding));
    };
    const auto [low1, high1] = range(1);
    const auto [low2, high2] = range(2);
    for (int b = low2; b <= high2; ++b)
      for (int a = low1; a <= high1; ++a)
        for (int k : cells_[static_cast<std::size_t>(b) * side_ + a]) visit(all_[k].vertex, all_[k].weights);
  }

 private:
  struct Entry {
    int vertex;
    FaceWeights weights;
  };
  int cell(double weight) const { return static_cast<int>(std::clamp(weight, 0.0, 0.999999) * side_); }

  std::vector<Entry> all_;
  std::vector<std::vector<int>> cells_;
  int side_ = 1;
};

/// What a triangle covers of one base face.
struct Piece {
  int face;
  PlaneMotion motion;  ///< from the plane of the triangle's face
  Transition change;   ///< from the face's chart to that of the triangle's face
};

/// Finds for every vertex the dyadic triangle that has moved onto it. A triangle may have moved out of its base face
/// altogether, so where it is follows from its neighbours.
class DomainInverse {
 public:
  DomainInverse(const Atlas& atlas, const SmoothedDomain& domain)
      : domain_(domain), n_(domain.steps()), cells_(domain.base().faces.size()), found_(atlas.patch.size()) {
    for (int v = 0; v < static_cast<int>(found_.size()); ++v)
      if (atlas.is_free(v)) cells_[atlas.patch[v]].add(v, chart_barycentric(atlas.position[v]));
    for (FaceCells& cells : cells_) cells.sort();
    seen_.resize(domain.base().faces.size() * 2 * n_ * n_);
    for (int f = 0; f < domain.base().face_count(); ++f)
      for_each_grid_triangle(f, n_, [&](const GridTriangle& t) { start_within(t); });
    for (std::size_t k = 0; k < open_.size(); ++k) {
      const auto [here, start] = open_[k];
      spread(here.corners(), start);
      go_on(here);
    }
  }

  const Found& of(int vertex) const { return found_[vertex]; }

 private:
  /// A triangle whose centre has not left its base face lies where its plane says.
  void start_within(const GridTriangle& here) {
    const DyadicTriangle t = here.corners();
    const Piece own = {t.face, {}, {}};
    const FaceWeights centre = weights_at(own, middle(t, {0, 1, 2}));
    if (!(*std::min_element(centre.begin(), centre.end()) >= 0.0)) return;
    seen(here) = true;
    open_.emplace_back(here, own);
  }

  /// The neighbours of the triangle last spread that are not located yet begin where it has the edge between.
  void go_on(const GridTriangle& here) {
    for (int side = 0; side < 3; ++side) {
      Transition change;
      PlaneMotion motion;
      const std::optional<GridTriangle> next = beside(here, side, motion, change);
      if (!next || seen(*next)) continue;
      seen(*next) = true;
      const Piece& piece = piece_at(middle(here.corners(), {side, (side + 1) % 3}));
      open_.emplace_back(*next, Piece{piece.face, piece.motion * motion, change * piece.change});
    }
  }

  char& seen(const GridTriangle& t) {
    return seen_[((static_cast<std::size_t>(t.face) * n_ + t.j) * n_ + t.i) * 2 + (t.down ? 1 : 0)];
  }

  /// The triangle beyond side `side`, from corner `side` to the next; where it lies in another base face, the motion
  /// from that face's plane and the change to its chart.
  std::optional<GridTriangle> beside(const GridTriangle& t, int side, PlaneMotion& motion, Transition& change) const {
    const auto [face, i, j, down] = t;
    if (down) {
      if (side == 2) return GridTriangle{face, i, j, false};
      return GridTriangle{face, i + (side == 0), j + (side == 1), false};
    }
    const std::array<bool, 3> on_edge = {j == 0, i + j == n_ - 1, i == 0};
    if (!on_edge[side]) return GridTriangle{face, i - (side == 2), j - (side == 0), true};
    const int h = 3 * face + side, twin = domain_.base().twins[h];
    if (twin < 0) return std::nullopt;
    motion = domain_.unfold(h);
    change = domain_.base().across(h);
    const int along = n_ - 1 - std::array{i, j, n_ - 1 - j}[side];
    const std::array<int, 3> there_i = {along, n_ - 1 - along, 0}, there_j = {0, along, n_ - 1 - along};
    return GridTriangle{twin / 3, there_i[twin % 3], there_j[twin % 3], false};
  }

  /// The mean of some of a triangle's corners, in the plane of its face.
  Complex middle(const DyadicTriangle& t, std::initializer_list<int> corners) const {
    Complex sum = 0.0;
    for (int c : corners) sum += domain_.at(t.face, t.i[c], t.j[c]);
    return sum / static_cast<double>(corners.size());
  }

  FaceWeights weights_at(const Piece& piece, Complex z) const {
    const auto& plane = domain_.corners(piece.face);
    return barycentric(piece.motion.apply(z), plane[0], plane[1], plane[2]);
  }

  /// The piece of the triangle last spread that has a point of it deepest inside.
  const Piece& piece_at(Complex z) const {
    double deepest = -1e300;
    const Piece* best = &pieces_.front();
    for (const Piece& piece : pieces_) {
      const FaceWeights w = weights_at(piece, z);
      const double depth = std::min({w[0], w[1], w[2]});
      if (!(depth > deepest)) continue;
      deepest = depth;
      best = &piece;
    }
    return *best;
  }

  /// No base vertex lies inside a triangle, so what it covers of a base face is connected through the edge by which it
  /// came.
  void spread(const DyadicTriangle& t, const Piece& start) {
    const BaseComplex& base = domain_.base();
    pieces_.assign(1, start);
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const Piece here = pieces_[p];
      const std::array<FaceWeights, 3> corners = weights_in(here, t);
      search(here, t, corners);
      for (int k = 0; k < 3; ++k) {
        const int h = 3 * here.face + k, twin = base.twins[h];
        if (twin < 0 || !crosses(corners, k) || pieces_.size() == kMostPieces) continue;
        const Piece next = {twin / 3, domain_.unfold(h).inverse() * here.motion,
                            here.change * base.across(h).inverse()};
        const auto known = [&](const Piece& other) { return other.face == next.face; };
        if (std::none_of(pieces_.begin(), pieces_.end(), known)) pieces_.push_back(next);
      }
    }
  }

  std::array<FaceWeights, 3> weights_in(const Piece& piece, const DyadicTriangle& t) const {
    std::array<FaceWeights, 3> weights;
    for (int c = 0; c < 3; ++c) weights[c] = weights_at(piece, domain_.at(t.face, t.i[c], t.j[c]));
    return weights;
  }

  /// Whether a triangle of the given weights reaches beyond edge k of the base face through that edge itself.
  static bool crosses(const std::array<FaceWeights, 3>& corners, int k) {
    const int across = (k + 2) % 3, along = (k + 1) % 3;
    double low = 2.0, high = -1.0;
    for (int c = 0; c < 3; ++c) {
      const FaceWeights &p = corners[c], &q = corners[(c + 1) % 3];
      if ((p[across] < 0.0) == (q[across] < 0.0)) continue;
      const double at = p[along] + p[across] / (p[across] - q[across]) * (q[along] - p[along]);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    return std::min(high, 1.0) > std::max(low, 0.0);
  }

  void search(const Piece& piece, const DyadicTriangle& t, const std::array<FaceWeights, 3>& corners) {
    const auto flat = [](const FaceWeights& w) { return Complex(w[1], w[2]); };
    const Complex a = flat(corners[0]), b = flat(corners[1]), c = flat(corners[2]);
    if (!(chart_area(a, b, c) > 0.0)) return;
    cells_[piece.face].for_each_within(corners, [&](int vertex, const FaceWeights& at) {
      const FaceWeights w = barycentric(flat(at), a, b, c);
      const double least = std::min({w[0], w[1], w[2]});
      Found& found = found_[vertex];
      if (least <= found.least) return;
      const double u1 = (w[0] * t.i[0] + w[1] * t.i[1] + w[2] * t.i[2]) / domain_.steps();
      const double u2 = (w[0] * t.j[0] + w[1] * t.j[1] + w[2] * t.j[2]) / domain_.steps();
      found = {least, t.face, piece.change, chart_position(1.0 - u1 - u2, u1)};
    });
  }

  const SmoothedDomain& domain_;
  const int n_;
  std::vector<FaceCells> cells_;
  std::vector<Found> found_;
  std::vector<Piece> pieces_;
  std::vector<char> seen_;                            ///< per grid triangle
  std::vector<std::pair<GridTriangle, Piece>> open_;  ///< located by a piece that they cover
};

}  // namespace

int smooth_by_loop(Atlas& atlas, Progress& progress) {
  progress.report("smooth by Loop", 0.0);
  const double per_face = double(atlas.surface->mesh.face_count()) / atlas.base.face_count();
  const int levels = std::clamp(static_cast<int>(std::ceil(std::log2(per_face) / 2.0)) + 1, 1, kMostLevels);
  const SmoothedDomain domain(atlas.base, true_shapes(atlas.base, atlas.surface->mesh.positions), levels);
  const DomainInverse inverse(atlas, domain);
  for (int v = 0; v < atlas.surface->mesh.vertex_count(); ++v) {
    const Found& found = inverse.of(v);
    if (found.least < -kRounding) continue;  // corners, and the boundary, which stays
    if (!found.change.is_identity() || found.face != atlas.patch[v]) atlas.change_chart(v, found.face, found.change);
    atlas.position[v] = found.position;
  }
  const int folded = static_cast<int>(find_folds(atlas).faces.size());
  if (folded > 0) {
    repair_folds(atlas, kRepairRings, progress);
    atlas.reassign_all();
  }
  progress.report("smooth by Loop", 1.0);
  return folded;
}

}  // namespace gsp
