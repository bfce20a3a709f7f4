#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

/// `weight` times what is at `from` goes to `to`.
struct Tap {
  int to, from;
  double weight;
};

/// A sparse linear map between two levels of a mesh, known by the taps that each vertex and each edge of the coarser one
/// brings. Taps with the same ends add up.
class Filter {
 public:
  explicit Filter(const SubdivisionLevel& coarse) : level_(coarse) {}
  virtual ~Filter() = default;

  virtual void vertex_taps(int vertex, std::vector<Tap>& out) const = 0;
  virtual void edge_taps(int edge, std::vector<Tap>& out) const = 0;

  const SubdivisionLevel& level() const { return level_; }

 protected:
  /// The vertex that an edge inserts.
  int odd(int edge) const { return level_.vertex_count + edge; }

  const SubdivisionLevel& level_;  ///< outlives the filter
};

/// y += filter·x, without a matrix. O(taps).
void add_filtered(const Filter& filter, const Vec3* x, Vec3* y);

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The same as a matrix, for many products. `rows`, `columns`: number of targets and sources.
SparseMatrix matrix_of(const Filter& filter, int rows, int columns);

}  // namespace gsp
