#pragma once

#include <cstdint>
#include <vector>

#include "mesh/export.h"
#include "mesh/progress.h"
#include "remesh/semiregular.h"

namespace GSP_PUBLIC gsp {

/// Loop's low-pass with its quadrature-mirror high-pass of 19 taps (the progressive geometry coder's) or of 11 taps;
/// Butterfly interpolation, whose unlifted details keep the normality of normal meshes, and lifted to have no mean.
enum class Wavelet : std::uint8_t { Loop = 0, Loop11 = 1, Butterfly = 2, ButterflyLifted = 3 };
inline constexpr Wavelet kWavelets[] = {Wavelet::Loop, Wavelet::Loop11, Wavelet::Butterfly, Wavelet::ButterflyLifted};

/// Synthesis x_{l+1} = P x_l + Q d_l over the levels of one connectivity, and its inverse.
///
/// Coefficients are stored as the mesh stores positions: those of base vertices first, then for each level those of its
/// edges in edge order, so that the coefficient at index V_l + e belongs to edge e of level l.
class WaveletTransform {
 public:
  /// `levels`: those whose edges carry details, from the base to the last but one of the mesh. O(vertices).
  explicit WaveletTransform(std::vector<SubdivisionLevel> levels, Wavelet wavelet = Wavelet::Loop);
  ~WaveletTransform();
  WaveletTransform(WaveletTransform&&) noexcept;

  const std::vector<SubdivisionLevel>& levels() const { return levels_; }

  /// One step, P c + Q d: positions of level l+1 from those of level l and the details of its edges. O(vertices), on
  /// one thread.
  std::vector<Vec3> synthesis(int level, std::vector<Vec3> coarse, const std::vector<Vec3>& details) const;

  struct Split {
    std::vector<Vec3> coarse;
    std::vector<Vec3> details;
    int iterations = 0;  ///< of the iterative solver; 0 where there is a closed form
  };

  /// Solves [P Q][c; d] = x to rounding (relative residual 1e-13 in each coordinate). O(vertices): in closed form for
  /// Butterfly, for Loop about 40 iterations of two products with [P Q], the same bits for any number of threads.
  /// Throws Error(SolverFailed) where it does not converge.
  Split analysis(int level, const std::vector<Vec3>& fine) const;

 private:
  struct Step;
  Split interpolating_analysis(int level, const std::vector<Vec3>& fine) const;

  std::vector<SubdivisionLevel> levels_;
  std::vector<Step> steps_;
};

}  // namespace gsp
