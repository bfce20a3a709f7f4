#pragma once

/// What counts as rounding in a chart, whose triangle has sides of 1. Positions are rounded to some 1e-16; each of
/// these is clear of what the ones before it may leave.
namespace gsp::tolerance {

/// Area of a face from which on it is upright.
inline constexpr double kUprightArea = 1e-15;
/// A face that reaches less far over a base edge, or a gap that is narrower, is not there.
inline constexpr double kReach = 1e-12;
/// A point outside of a chart's triangle by less lies on its edge.
inline constexpr double kOnEdge = 1e-10;
/// Two places that are one: of a vertex seen from two faces, of a length that is that of a base edge. `check_map` asks
/// as much of every map.
inline constexpr double kSamePlace = 1e-9;
/// The same about a corner whose map may be folded, where ways that do not close are off by whole edges.
inline constexpr double kSameWay = 1e-6;

static_assert(kUprightArea < kReach && kReach < kOnEdge && kOnEdge < kSamePlace && kSamePlace < kSameWay);

}  // namespace gsp::tolerance
