#pragma once

#include "param/options.h"

namespace gsp {

/// The automatic end of the simplification (§3.1.1, figure 5d): before the third stage, in which metric distortion
/// dominates Ω. Both parts of Ω are followed by running means over a window that shrinks with the complex. On the
/// paper's models metric distortion takes over within a factor of two in vertices of where it has reached a quarter of
/// the other parts, and Table 1's base sizes lie around there; beyond it patches wrap around limbs.
class AutomaticStop {
 public:
  explicit AutomaticStop(int vertices) : start_(vertices) {}

  /// Takes the next removal; true where it should not be made any more.
  bool reached(const OmegaRecord& next) {
    const double step = 1.0 / (kWindow * next.remaining_vertices + 8.0);
    quality_ += step * (next.shape + next.dispersion - quality_);
    metric_ += step * (next.metric - metric_);
    return next.remaining_vertices < kLatest * start_ && metric_ > kDominance * quality_;
  }

 private:
  static constexpr double kWindow = 0.05;  // of the remaining vertices
  static constexpr double kDominance = 0.25;
  static constexpr double kLatest = 0.1;  // the first stage is never taken for the third
  int start_;
  double quality_ = 0.0;
  double metric_ = 0.0;
};

}  // namespace gsp
