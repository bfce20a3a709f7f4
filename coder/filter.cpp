#include "coder/filter.h"

#include <algorithm>

namespace gsp {

namespace {

/// Hands all taps to `take`, in batches that stay in the cache.
template <class Take>
void for_each_tap(const Filter& filter, Take take) {
  constexpr int kBatch = 64;
  std::vector<Tap> taps;
  const auto go_through = [&](int count, auto append) {
    for (int begin = 0; begin < count; begin += kBatch) {
      taps.clear();
      for (int i = begin; i < std::min(begin + kBatch, count); ++i) append(i);
      for (const Tap& tap : taps) take(tap);
    }
  };
  go_through(filter.level().vertex_count, [&](int v) { filter.vertex_taps(v, taps); });
  go_through(filter.level().edge_count(), [&](int e) { filter.edge_taps(e, taps); });
}

}  // namespace

void add_filtered(const Filter& filter, const Vec3* x, Vec3* y) {
  for_each_tap(filter, [&](const Tap& tap) { y[tap.to] += tap.weight * x[tap.from]; });
}

SparseMatrix matrix_of(const Filter& filter, int rows, int columns) {
  std::vector<Eigen::Triplet<double>> entries;
  for_each_tap(filter, [&](const Tap& tap) { entries.emplace_back(tap.to, tap.from, tap.weight); });
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace gsp
