#include "remesh/chart_samples.h"

#include <algorithm>
#include <cmath>

namespace gsp {

namespace {

/// A point this near to a face (chart units) may be in it: far above rounding, far below the spacing of any lattice.
constexpr double kBorder = 1e-10;

/// A face in lattice coordinates x + yω, in units of the lattice's spacing, counter-clockwise.
struct Placed {
  std::array<double, 3> x, y;
  std::array<int, 3> corner = {0, 1, 2};  ///< which of the face's corners each is
  double area = 0.0;                      ///< twice, in lattice units
  bool flipped = false;

  Placed(const std::array<Complex, 3>& corners, const Transition& motion, int n) {
    for (int k = 0; k < 3; ++k) {
      const Complex z = motion.apply(corners[k]);
      y[k] = z.imag() / kOmegaIm * n;
      x[k] = z.real() * n - kOmegaRe * y[k];
    }
    area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    flipped = area < 0.0;
    if (!flipped) return;
    area = -area;
    std::swap(x[1], x[2]);
    std::swap(y[1], y[2]);
    std::swap(corner[1], corner[2]);
  }

  /// Twice the area of the edge opposite corner k with the point (px, py): `area` times its weight.
  double opposite(int k, double px, double py) const {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    return (x[b] - x[a]) * (py - y[a]) - (y[b] - y[a]) * (px - x[a]);
  }
};

double dot(Complex a, Complex b) { return a.real() * b.real() + a.imag() * b.imag(); }

}  // namespace

ChartSamples::ChartSamples(const Parameterization& map, const std::vector<FacePiece>& pieces, int n)
    : map_(map), pieces_(pieces), n_(n), samples_(static_cast<std::size_t>(n + 1) * (n + 2) / 2) {
  for (std::size_t p = 0; p < pieces.size(); ++p) scan(static_cast<int>(p));
}

void ChartSamples::scan(int piece) {
  const int face = pieces_[piece].face;
  const Placed t(map_.face_corners[face], pieces_[piece].motion, n_);
  if (!(t.area > 0.0) || !std::isfinite(t.area)) return;
  std::array<double, 3> slack;
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    slack[k] = kBorder * n_ * (std::abs(t.x[b] - t.x[a]) + std::abs(t.y[b] - t.y[a]));
  }
  const double reach = kBorder * n_;
  const auto [low_y, high_y] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const int first_row = static_cast<int>(std::ceil(std::clamp(low_y - reach, 0.0, n_ + 1.0)));
  const int last_row = static_cast<int>(std::floor(std::clamp(high_y + reach, -1.0, static_cast<double>(n_))));
  for (int j = first_row; j <= last_row; ++j) {
    double low = 0.0, high = n_ - j;
    for (int k = 0; k < 3; ++k) {
      const double at_zero = t.opposite(k, 0.0, j) + slack[k];
      const double slope = t.y[(k + 1) % 3] - t.y[(k + 2) % 3];
      if (slope > 0.0) low = std::max(low, -at_zero / slope);
      if (slope < 0.0) high = std::min(high, -at_zero / slope);
      if (slope == 0.0 && at_zero < 0.0) high = -1.0;
    }
    if (!(low <= high)) continue;
    for (int i = static_cast<int>(std::ceil(low)); i <= high; ++i) {
      SurfacePoint found;
      found.face = face;
      double smallest = 1.0;
      for (int k = 0; k < 3; ++k) {
        const double w = t.opposite(k, i, j) / t.area;
        found.weights[t.corner[k]] = w;
        smallest = std::min(smallest, w);
      }
      found.fit = std::max(smallest, -1.0) - (t.flipped ? SurfacePoint::kFlipped : 0.0);
      Sample& sample = samples_[lattice_index(n_, i, j)];
      if (!found.better_than(sample.point)) continue;
      found.weights = snapped_weights(found.weights);
      sample = {found, piece};
    }
  }
}

SurfacePoint ChartSamples::nearest_in(int piece, Complex z) const {
  const int face = pieces_[piece].face;
  std::array<Complex, 3> c = map_.face_corners[face];
  for (Complex& corner : c) corner = pieces_[piece].motion.apply(corner);
  SurfacePoint best;
  double nearest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Complex a = c[k], side = c[(k + 1) % 3] - a;
    const double length = dot(side, side);
    const double t = length > 0.0 ? std::clamp(dot(z - a, side) / length, 0.0, 1.0) : 0.0;
    const double distance = std::abs(z - (a + t * side));
    if (best.face >= 0 && !(distance < nearest)) continue;
    nearest = distance;
    best.face = face;
    best.weights = {0.0, 0.0, 0.0};
    best.weights[k] = 1.0 - t;
    best.weights[(k + 1) % 3] = t;
  }
  best.fit = -SurfacePoint::kNear - nearest;
  return best;
}

ChartSamples::Sample ChartSamples::nearest_around(int i, int j) const {
  static constexpr int kAround[6][2] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
  const Complex z((i + kOmegaRe * j) / n_, kOmegaIm * j / n_);
  Sample best;
  for (const auto& [di, dj] : kAround) {
    const int x = i + di, y = j + dj;
    if (x < 0 || y < 0 || x + y > n_) continue;
    const int piece = samples_[lattice_index(n_, x, y)].piece;
    if (piece < 0) continue;
    const SurfacePoint candidate = nearest_in(piece, z);
    if (candidate.better_than(best.point)) best = {candidate, piece};
  }
  return best;
}

void ChartSamples::put_on_crease(int k) {
  for (int s = 0; s <= n_; ++s) {
    const auto [i, j] = along_side(n_, k, s);
    SurfacePoint& point = samples_[lattice_index(n_, i, j)].point;
    if (point.face >= 0) point = on_crease(point);
  }
}

void ChartSamples::fill_gaps() {
  std::vector<std::array<int, 2>> gaps;
  for (int j = 0; j <= n_; ++j)
    for (int i = 0; i + j <= n_; ++i)
      if (at(i, j).face < 0) gaps.push_back({i, j});
  while (!gaps.empty()) {
    std::vector<std::array<int, 2>> left;
    std::vector<std::pair<std::size_t, Sample>> found;
    for (const auto& [i, j] : gaps) {
      const Sample sample = nearest_around(i, j);
      if (sample.piece >= 0)
        found.emplace_back(lattice_index(n_, i, j), sample);
      else
        left.push_back({i, j});
    }
    if (found.empty()) return;
    for (const auto& [at, sample] : found) samples_[at] = sample;
    gaps = std::move(left);
  }
}

}  // namespace gsp
