#include "metrics/area_sampler.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/error.h"
#include "mesh/random.h"

namespace gsp {

namespace {

/// An affine image of the unit triangle (0,0), (1,0), (0,1): origin and two edges.
struct Cell {
  double s, t;
  double edge1_s, edge1_t;
  double edge2_s, edge2_t;

  Cell inside(const Cell& outer) const {
    return {outer.s + s * outer.edge1_s + t * outer.edge2_s,   outer.t + s * outer.edge1_t + t * outer.edge2_t,
            edge1_s * outer.edge1_s + edge1_t * outer.edge2_s, edge1_s * outer.edge1_t + edge1_t * outer.edge2_t,
            edge2_s * outer.edge1_s + edge2_t * outer.edge2_s, edge2_s * outer.edge1_t + edge2_t * outer.edge2_t};
  }
};

constexpr int kBisections = 8;
constexpr int kCells = 1 << kBisections;

/// The curve enters a cell at its origin and leaves it at the end of its second edge; the corner between is the end of
/// the first. Halving the side from entry to exit gives the two cells that follow each other on the curve.
std::array<Cell, kCells> sierpinski_cells() {
  constexpr Cell first = {0.0, 0.0, 0.0, 0.5, 1.0, 0.0};
  constexpr Cell second = {1.0, 0.0, -1.0, 0.5, -1.0, 1.0};
  std::array<Cell, kCells> cells;
  for (int index = 0; index < kCells; ++index) {
    Cell cell = {0.0, 0.0, 1.0, 0.0, 0.0, 1.0};
    for (int bit = kBisections - 1; bit >= 0; --bit) cell = ((index >> bit) & 1 ? second : first).inside(cell);
    cells[index] = cell;
  }
  return cells;
}

/// The point of the unit triangle at fraction r of its area along the curve; `random` places it within the last cell.
std::array<double, 2> triangle_point(double r, std::uint32_t random) {
  static const std::array<Cell, kCells> kTable = sierpinski_cells();
  const auto index = static_cast<std::uint32_t>(std::clamp(r, 0.0, 1.0 - 0x1.0p-17) * 0x1.0p16);
  const Cell cell = kTable[index & (kCells - 1)].inside(kTable[index >> kBisections]);
  double s = ((random >> 16) + 0.5) * 0x1.0p-16, t = ((random & 0xffff) + 0.5) * 0x1.0p-16;
  if (s + t > 1.0) {
    s = 1.0 - s;
    t = 1.0 - t;
  }
  return {cell.s + s * cell.edge1_s + t * cell.edge2_s, cell.t + s * cell.edge1_t + t * cell.edge2_t};
}

}  // namespace

struct AreaSampler::Span {
  double begin, end;
  double weight;
  Vec3 corner, edge1, edge2;
};

AreaSampler::AreaSampler(const Mesh& mesh, const std::vector<int>& order, const std::vector<double>& areas,
                         std::vector<float> density, std::size_t samples, std::uint64_t seed)
    : mesh_(mesh),
      order_(order),
      density_(std::move(density)),
      cumulative_(order.size() + 1, 0.0),
      samples_(samples),
      seed_(seed) {
  double area = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    area += areas[i];
    cumulative_[i + 1] = cumulative_[i] + (density_.empty() ? areas[i] : areas[i] * density_[i]);
  }
  if (!(area > 0.0)) throw Error(Cause::NoFaces, "a surface without area has no samples");
  density_scale_ = cumulative_.back() / area;
}

AreaSampler::Span AreaSampler::span(std::size_t place) const {
  const Triangle& corners = mesh_.faces[order_[place]];
  const Vec3& corner = mesh_.positions[corners[0]];
  return {cumulative_[place],
          cumulative_[place + 1],
          density_.empty() ? 1.0 : density_scale_ / density_[place],
          corner,
          mesh_.positions[corners[1]] - corner,
          mesh_.positions[corners[2]] - corner};
}

std::size_t AreaSampler::place_of(double target) const {
  const auto after = std::upper_bound(cumulative_.begin(), cumulative_.end(), target);
  const auto last = std::lower_bound(cumulative_.begin(), cumulative_.end(), cumulative_.back());
  return static_cast<std::size_t>(std::min(after, last) - cumulative_.begin()) - 1;
}

void AreaSampler::sample(std::size_t begin, std::size_t end, Vec3* out, double* weight) const {
  const double stratum = cumulative_.back() / static_cast<double>(samples_);
  Random random(seed_ + 0xd1b54a32d192ed03ULL * (begin / kBlock + 1));
  std::size_t place = place_of(static_cast<double>(begin) * stratum);
  Span face = span(place);
  for (std::size_t k = begin; k < end; ++k) {
    const std::uint64_t bits = random.next();
    const double jitter = static_cast<double>(bits >> 32) * 0x1.0p-32;
    const double target = std::min((static_cast<double>(k) + jitter) * stratum, cumulative_.back());
    if (target >= face.end) {
      // A few steps reach the next face; a search serves long runs of faces without area.
      for (int step = 0; step < 8 && place + 1 < order_.size() && target >= cumulative_[place + 1]; ++step) ++place;
      if (target >= cumulative_[place + 1]) place = place_of(target);
      face = span(place);
    }
    const auto [s, t] =
        triangle_point((target - face.begin) / (face.end - face.begin), static_cast<std::uint32_t>(bits));
    out[k - begin] = face.corner + s * face.edge1 + t * face.edge2;
    weight[k - begin] = face.weight;
  }
}

}  // namespace gsp
