#include "coder/wavelet_transform.h"

#include <algorithm>
#include <memory>
#include <string>

#include "coder/loop_high_pass.h"
#include "mesh/error.h"
#include "mesh/parallel.h"
#include "remesh/filters/butterfly_low_pass.h"
#include "remesh/filters/butterfly_update.h"
#include "remesh/filters/loop_low_pass.h"

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

Scalars coordinate_dots(const Points& a, const Points& b) {
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

/// [P Q] of one step as matrices, for an iterative solver.
class Synthesis {
 public:
  Synthesis(const Filter& low_pass, const Filter& high_pass) {
    const int vertices = low_pass.level().vertex_count, edges = low_pass.level().edge_count();
    low_pass_ = low_pass.matrix(vertices + edges, vertices);
    high_pass_ = high_pass.matrix(vertices + edges, edges);
  }

  Points operator()(const Points& both) const {
    Points fine(low_pass_.rows(), Vec3::Zero());
    parallel_for(fine.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      add_product(low_pass_, both.data(), begin, end, fine);
      add_product(high_pass_, both.data() + low_pass_.cols(), begin, end, fine);
    });
    return fine;
  }

 private:
  SparseMatrix low_pass_, high_pass_;
};

}  // namespace

/// Loop's step is P c + Q d. An interpolating scheme's details move the vertices on their edges; lifting takes `update`
/// of the details off the old ones first.
struct WaveletTransform::Step {
  std::unique_ptr<Filter> low_pass;
  std::unique_ptr<Filter> high_pass;  ///< none where the scheme interpolates
  std::unique_ptr<Filter> update;     ///< of lifted wavelets
};

WaveletTransform::WaveletTransform(std::vector<SubdivisionLevel> levels, Wavelet wavelet) : levels_(std::move(levels)) {
  for (const SubdivisionLevel& level : levels_) {
    Step& step = steps_.emplace_back();
    if (wavelet == Wavelet::Loop || wavelet == Wavelet::Loop11) {
      step.low_pass = loop_low_pass(level);
      step.high_pass = loop_high_pass(level, wavelet == Wavelet::Loop11);
    } else {
      step.low_pass = butterfly_low_pass(level);
      if (wavelet == Wavelet::ButterflyLifted) step.update = butterfly_update(level);
    }
  }
}

WaveletTransform::~WaveletTransform() = default;
WaveletTransform::WaveletTransform(WaveletTransform&&) noexcept = default;

std::vector<Vec3> WaveletTransform::synthesis(int level, std::vector<Vec3> coarse,
                                              const std::vector<Vec3>& details) const {
  const Step& step = steps_[level];
  if (step.update) {
    Points update(coarse.size(), Vec3::Zero());
    step.update->add(details.data(), update.data());
    for (std::size_t v = 0; v < coarse.size(); ++v) coarse[v] -= update[v];
  }
  Points fine(coarse.size() + details.size(), Vec3::Zero());
  step.low_pass->add(coarse.data(), fine.data());
  if (step.high_pass)
    step.high_pass->add(details.data(), fine.data());
  else
    for (std::size_t e = 0; e < details.size(); ++e) fine[coarse.size() + e] += details[e];
  return fine;
}

WaveletTransform::Split WaveletTransform::interpolating_analysis(int level, const std::vector<Vec3>& fine) const {
  const Step& step = steps_[level];
  const std::size_t coarse_count = levels_[level].vertex_count;
  const auto middle = fine.begin() + static_cast<std::ptrdiff_t>(coarse_count);
  Split split{{fine.begin(), middle}, {middle, fine.end()}};
  Points predicted(fine.size(), Vec3::Zero());
  step.low_pass->add(split.coarse.data(), predicted.data());
  for (std::size_t e = 0; e < split.details.size(); ++e) split.details[e] -= predicted[coarse_count + e];
  if (step.update) step.update->add(split.details.data(), split.coarse.data());
  return split;
}

WaveletTransform::Split WaveletTransform::analysis(int level, const std::vector<Vec3>& fine) const {
  const Step& step = steps_[level];
  if (!step.high_pass) return interpolating_analysis(level, fine);
  // BiCGSTAB (van der Vorst 1992) without a preconditioner: the filters' diagonal is all but constant, their condition
  // about 5. Sampling the fine mesh is a start whose residual is already as small as the details.
  constexpr double kTolerance = 1e-13;
  constexpr int kMaxIterations = 500;
  const Synthesis synthesize(*step.low_pass, *step.high_pass);
  const std::size_t n = fine.size(), coarse_count = levels_[level].vertex_count;
  Points x(n, Vec3::Zero());
  std::copy_n(fine.begin(), coarse_count, x.begin());
  Points r = synthesize(x);
  for_each(n, [&](std::size_t i) { r[i] = fine[i] - r[i]; });
  const Points shadow = r;
  Points p(n, Vec3::Zero()), v(n, Vec3::Zero()), s(n);
  Scalars rho = Scalars::Ones(), alpha = Scalars::Ones(), omega = Scalars::Ones();
  const Scalars target = coordinate_dots(fine, fine) * (kTolerance * kTolerance);
  Split split;
  while ((coordinate_dots(r, r) > target).any()) {
    if (++split.iterations > kMaxIterations)
      throw Error(Cause::SolverFailed, "wavelet analysis of level " + std::to_string(level) + " did not converge");
    const Scalars next_rho = coordinate_dots(shadow, r);
    const Scalars beta = ratio(next_rho, rho) * ratio(alpha, omega);
    rho = next_rho;
    for_each(n, [&](std::size_t i) { p[i].array() = r[i].array() + beta * (p[i].array() - omega * v[i].array()); });
    v = synthesize(p);
    alpha = ratio(rho, coordinate_dots(shadow, v));
    for_each(n, [&](std::size_t i) { s[i].array() = r[i].array() - alpha * v[i].array(); });
    const Points t = synthesize(s);
    omega = ratio(coordinate_dots(t, s), coordinate_dots(t, t));
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
