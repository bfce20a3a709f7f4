#pragma once

#include <span>
#include <vector>

#include "mesh/files/polygon_cutter.h"
#include "mesh/surface_file.h"

namespace gsp {

/// Collects a file's polygons as triangles, and how they are numbered. Polygons of fewer than three corners (wire
/// frames and points) carry no surface: they are counted and left out.
class PolygonBuilder {
 public:
  /// The file must have its vertices and the number of the first one already.
  explicit PolygonBuilder(SurfaceFile& file) : file_(file) {}

  /// `corners` count from 0. Throws Error: IndexOutOfRange, PolygonNotSimple, with the number of the polygon in the
  /// file.
  void add(std::span<const long long> corners);

  /// Notes what was left out.
  void finish();

 private:
  void require_in_range(std::span<const long long> corners) const;
  void cut(std::span<const long long> corners);
  void number_faces(std::size_t faces_before);

  SurfaceFile& file_;
  PolygonCutter cutter_;
  std::vector<Vec3> positions_;
  long long polygon_ = 0;    ///< polygons so far
  bool renumbered_ = false;  ///< some polygon is not one face
  long long without_surface_ = 0;
};

}  // namespace gsp
