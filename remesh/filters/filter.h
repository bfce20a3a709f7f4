#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A sparse linear map between two levels of a mesh.
class Filter {
 public:
  explicit Filter(const SubdivisionLevel& coarse) : level_(coarse) {}
  virtual ~Filter() = default;

  /// y += filter·x, without a matrix. O(taps).
  virtual void add(const Vec3* x, Vec3* y) const = 0;
  /// The same as a matrix, for many products. `rows`, `columns`: number of targets and sources.
  virtual SparseMatrix matrix(int rows, int columns) const = 0;

  const SubdivisionLevel& level() const { return level_; }

 protected:
  /// The vertex that an edge inserts.
  int odd(int edge) const { return level_.vertex_count + edge; }

  const SubdivisionLevel& level_;  ///< outlives the filter
};

/// A filter that is known by its taps: Derived::for_each_tap(take) calls take(to, from, weight) for each, where
/// `weight` times what is at `from` goes to `to`. Taps with the same ends add up.
template <class Derived>
class TapFilter : public Filter {
 public:
  using Filter::Filter;

  void add(const Vec3* x, Vec3* y) const override {
    derived().for_each_tap([&](int to, int from, double weight) { y[to] += weight * x[from]; });
  }

  SparseMatrix matrix(int rows, int columns) const override {
    std::vector<Eigen::Triplet<double>> entries;
    derived().for_each_tap([&](int to, int from, double weight) { entries.emplace_back(to, from, weight); });
    SparseMatrix matrix(rows, columns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

 private:
  const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

}  // namespace gsp
