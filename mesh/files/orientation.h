#pragma once

#include <Eigen/Core>

namespace gsp {

/// Sign of the area of the triangle a, b, c: 1 where it runs counter-clockwise, 0 where the three are collinear.
/// Exact (Shewchuk, "Adaptive precision floating-point arithmetic", 1997) as long as no product of two coordinates
/// overflows or loses bits to underflow.
int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace gsp
