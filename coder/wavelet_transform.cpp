#include "coder/wavelet_transform.h"

#include <algorithm>
#include <string>

#include "coder/butterfly_filters.h"
#include "coder/loop_filters.h"
#include "mesh/error.h"
#include "mesh/parallel.h"

namespace gsp {

namespace {

using Points = std::vector<Vec3>;
/// One number for each of the three coordinates, whose systems share a matrix and are solved side by side.
using Scalars = Eigen::Array3d;

constexpr std::size_t kGrain = 8192;

/// Rows [begin, end) of y += matrix * x.
void add_product(const SparseMatrix& matrix, const Vec3* x, std::size_t begin, std::size_t end, Points& y) {
  for (std::size_t r = begin; r < end; ++r) {
    Vec3 sum = y[r];
    for (SparseMatrix::InnerIterator it(matrix, static_cast<Eigen::Index>(r)); it; ++it)
      sum += it.value() * x[it.col()];
    y[r] = sum;
  }
}

/// Sum over i of term(i), block by block, so that it does not depend on the number of threads.
template <class Term>
Scalars sum(std::size_t count, Term term) {
  std::vector<Scalars> blocks((count + kGrain - 1) / kGrain, Scalars::Zero());
  parallel_for(count, kGrain, [&](std::size_t begin, std::size_t end) {
    Scalars block = Scalars::Zero();
    for (std::size_t i = begin; i < end; ++i) block += term(i);
    blocks[begin / kGrain] = block;
  });
  Scalars total = Scalars::Zero();
  for (const Scalars& block : blocks) total += block;
  return total;
}

Scalars dot(const Points& a, const Points& b) {
  return sum(a.size(), [&](std::size_t i) -> Scalars { return a[i].array() * b[i].array(); });
}

template <class Body>
void for_each(std::size_t count, Body body) {
  parallel_for(count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// a / b, 0 where b is: a coordinate that is solved exactly stands still.
Scalars ratio(const Scalars& a, const Scalars& b) { return (b != 0.0).select(a / (b != 0.0).select(b, 1.0), 0.0); }

/// The high-pass of an interpolating scheme: each detail moves the vertex on its edge.
SparseMatrix new_vertices(const SubdivisionLevel& level) {
  SparseMatrix matrix(level.vertex_count + level.edge_count(), level.edge_count());
  matrix.reserve(Eigen::VectorXi::Ones(matrix.rows()));
  for (int e = 0; e < level.edge_count(); ++e) matrix.insert(level.vertex_count + e, e) = 1.0;
  matrix.makeCompressed();
  return matrix;
}

}  // namespace

struct WaveletTransform::Impl {
  SparseMatrix low_pass, high_pass;
  SparseMatrix update;  ///< of lifted wavelets, else empty: synthesis is P (c - update d) + Q d

  /// Both filters of (coarse, details).
  Points synthesis(const Vec3* coarse, const Vec3* details) const {
    Points fine(low_pass.rows(), Vec3::Zero());
    Points lifted;
    if (update.size() != 0) {
      lifted.assign(low_pass.cols(), Vec3::Zero());
      parallel_for(lifted.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        add_product(update, details, begin, end, lifted);
        for (std::size_t v = begin; v < end; ++v) lifted[v] = coarse[v] - lifted[v];
      });
      coarse = lifted.data();
    }
    parallel_for(fine.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      add_product(low_pass, coarse, begin, end, fine);
      add_product(high_pass, details, begin, end, fine);
    });
    return fine;
  }
  Points synthesis(const Points& both) const { return synthesis(both.data(), both.data() + low_pass.cols()); }
};

WaveletTransform::WaveletTransform(const std::vector<SubdivisionLevel>& levels, Wavelet wavelet) {
  for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
    const SubdivisionLevel& level = levels[l];
    if (wavelet == Wavelet::Loop || wavelet == Wavelet::Loop11) {
      impl_.push_back({loop_low_pass(level), loop_high_pass(level, wavelet == Wavelet::Loop11), {}});
    } else {
      const bool lifted = wavelet == Wavelet::ButterflyLifted;
      impl_.push_back({butterfly_low_pass(level), new_vertices(level), lifted ? butterfly_update(level) : SparseMatrix()});
    }
  }
}

WaveletTransform::~WaveletTransform() = default;
WaveletTransform::WaveletTransform(WaveletTransform&&) noexcept = default;

int WaveletTransform::levels() const { return static_cast<int>(impl_.size()); }

std::vector<Vec3> WaveletTransform::synthesis(int level, const std::vector<Vec3>& coarse,
                                              const std::vector<Vec3>& details) const {
  return impl_[level].synthesis(coarse.data(), details.data());
}

WaveletTransform::Split WaveletTransform::analysis(int level, const std::vector<Vec3>& fine) const {
  // BiCGSTAB (van der Vorst 1992) without a preconditioner: the filters' diagonal is all but constant, their condition
  // about 5. Sampling the fine mesh is a start whose residual is already as small as the details.
  constexpr double kTolerance = 1e-13;
  constexpr int kMaxIterations = 500;
  const Impl& filters = impl_[level];
  const std::size_t n = fine.size(), coarse_count = filters.low_pass.cols();
  Points x(n, Vec3::Zero());
  std::copy_n(fine.begin(), coarse_count, x.begin());
  Points r = filters.synthesis(x);
  for_each(n, [&](std::size_t i) { r[i] = fine[i] - r[i]; });
  const Points shadow = r;
  Points p(n, Vec3::Zero()), v(n, Vec3::Zero()), s(n);
  Scalars rho = Scalars::Ones(), alpha = Scalars::Ones(), omega = Scalars::Ones();
  const Scalars target = dot(fine, fine) * (kTolerance * kTolerance);
  Split split;
  while ((dot(r, r) > target).any()) {
    if (++split.iterations > kMaxIterations)
      throw Error(Cause::SolverFailed, "wavelet analysis of level " + std::to_string(level) + " did not converge");
    const Scalars next_rho = dot(shadow, r);
    const Scalars beta = ratio(next_rho, rho) * ratio(alpha, omega);
    rho = next_rho;
    for_each(n, [&](std::size_t i) { p[i].array() = r[i].array() + beta * (p[i].array() - omega * v[i].array()); });
    v = filters.synthesis(p);
    alpha = ratio(rho, dot(shadow, v));
    for_each(n, [&](std::size_t i) { s[i].array() = r[i].array() - alpha * v[i].array(); });
    const Points t = filters.synthesis(s);
    omega = ratio(dot(t, s), dot(t, t));
    for_each(n, [&](std::size_t i) {
      x[i].array() += alpha * p[i].array() + omega * s[i].array();
      r[i].array() = s[i].array() - omega * t[i].array();
    });
  }
  split.coarse.assign(x.begin(), x.begin() + coarse_count);
  split.details.assign(x.begin() + coarse_count, x.end());
  return split;
}

}  // namespace gsp
