#include "remesh/filters/local_frames.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace gsp;

namespace {

/// Two faces at the edge from 0 to 1, the second turned about it by the given angle; at π it lies on the first.
std::vector<Vec3> hinge(double angle) {
  return {{0, 0, 0}, {1, 0, 0}, {0.4, 0.9, 0}, {0.4, -0.9 * std::cos(angle), 0.9 * std::sin(angle)}};
}

Frame frame_of(const std::vector<Vec3>& positions, FrameRule rule = FrameRule::ByArea) {
  const SubdivisionLevel level = base_level(4, {{0, 1, 2}, {1, 0, 3}});
  const EdgeFrames frames(level, positions, rule);
  for (int e = 0; e < level.edge_count(); ++e)
    if (level.edge_faces[e][1] >= 0) return frames(e);
  return Frame::Zero();
}

}  // namespace

TEST_CASE("frames of two flat faces are the plane's, also where one lies on the other, up to rounding") {
  const double kRounding = 1e-13;
  for (const double angle : {0.0, M_PI - 1e-3, M_PI, M_PI + 1e-3})
    for (int k = 0; k < 3; ++k) {
      INFO(angle << ' ' << k);
      std::vector<Vec3> moved = hinge(angle);
      moved[3][k] += kRounding;
      const Frame frame = frame_of(hinge(angle));
      CHECK((frame_of(moved) - frame).norm() < 100 * kRounding);
      CHECK((frame.transpose() * frame - Frame::Identity()).norm() < 1e-14);
      if (angle == 0.0 || angle == M_PI) CHECK((frame.col(0) - Vec3::UnitZ()).norm() < 1e-14);
    }
  const auto jump = [&](FrameRule rule) {
    return (frame_of(hinge(M_PI - kRounding), rule) - frame_of(hinge(M_PI + kRounding), rule)).norm();
  };
  CHECK(jump(FrameRule::ByArea) < 100 * kRounding);
  CHECK(jump(FrameRule::Steady) < 100 * kRounding);
  CHECK(jump(FrameRule::Mean) > 1.0);  // what versions up to 7 do there
}

TEST_CASE("frames turn continuously with a face that goes round its edge, and with one that grows thin") {
  for (double angle = 0.0; angle < 2 * M_PI; angle += 1e-3)
    CHECK((frame_of(hinge(angle + 1e-3)) - frame_of(hinge(angle))).norm() < 0.02);
  for (double height = 1e-3; height > 1e-12; height *= 0.9) {
    std::vector<Vec3> thin = hinge(1.0), thinner = thin;
    thin[3] = {0.4, 0.0, height};
    thinner[3] = {0.4, 0.0, 0.9 * height};
    CHECK((frame_of(thin) - frame_of(thinner)).norm() < 0.1);
    thinner[3] = {0.4, 1e-14, height};  // rounding does not show
    CHECK((frame_of(thin) - frame_of(thinner)).norm() < 1e-9);
  }
}

TEST_CASE("a thin face turns the frame by no more than its share of the area") {
  for (const double height : {0.05, 0.01, 1e-3})
    for (double angle = 0.0; angle < 2 * M_PI; angle += 0.1) {
      INFO(height << ' ' << angle);
      std::vector<Vec3> thin = hinge(0.0);
      thin[3] = {0.4, -height * std::cos(angle), height * std::sin(angle)};
      CHECK((frame_of(thin).col(0) - Vec3::UnitZ()).norm() < 1.1 * height / (0.9 - height));
    }
  std::vector<Vec3> thin = hinge(0.0);
  thin[3] = {0.4, 0.0, 0.01};
  CHECK((frame_of(thin, FrameRule::Steady).col(0) - Vec3::UnitZ()).norm() > 0.7);  // what version 8 does there
}
