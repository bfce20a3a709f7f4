#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/export.h"
#include "mesh/surface_file.h"

namespace GSP_PUBLIC gsp {

enum class Repair { None, Cut };
inline constexpr std::array kRepairs = {Repair::None, Repair::Cut};

/// none, cut.
const char* repair_name(Repair repair);

/// The inverse. Throws Error(BadOption).
Repair repair_of(const std::string& name);

struct ReadOptions {
  /// Joins vertices that lie within this share of the diagonal of the surface's bounding box, 0..kLargestWeld; 0 joins
  /// those at the same place, nothing joins none. For surfaces split along seams and STL whose corners differ by
  /// rounding.
  std::optional<double> weld = {};
  static constexpr double kLargestWeld = 0.01;

  /// After the weld. Cut takes surfaces that are no consistently oriented manifolds: cut_apart.h.
  Repair repair = Repair::None;
};

/// Reads a surface from PLY (ASCII, binary, both byte orders), OBJ, OFF or STL (ASCII, binary) by the name's ending,
/// case-insensitive, in double. Polygons are cut into triangles that lie in them (files/polygon_cutter.h), triangle
/// strips of PLY are unrolled, polygons of fewer than three corners are dropped, vertices of an STL that agree exactly
/// are welded, isolated vertices are kept, vertex order is the file's. What a format allows beside the surface
/// (colours, normals, texture) is passed over; what the surface may lack for it (points, curves, unknown statements) is
/// noted; what contradicts the file's own counts or lines is refused. No topological check is made, and coordinates
/// that are not finite are kept, so that a report can name them: see `topology.h`. The parsers are our own and not
/// OpenMesh's: those of 9.0 pass every coordinate through `float`, take indices out of range and truncated OFF files
/// for good, return uninitialised memory for "nan", and end in bad_alloc where a count lies.
/// tests/mesh/openmesh_test.cpp holds the two against each other on what both can read. Throws Error: CannotOpen,
/// UnknownFormat, Malformed, Truncated, IndexOutOfRange, PolygonNotSimple, with the place as the file counts it.
SurfaceFile read_surface(const std::string& path, const ReadOptions& options = {});

/// `read_surface` for callers that tell nobody of its notes and name no place of the file.
Mesh read_mesh(const std::string& path);

/// Writes by the name's ending: PLY (binary little-endian, double), OBJ, OFF (shortest decimals that read back as the
/// same numbers), STL (binary, single precision). `comments` go into the formats that have them, all but STL. The file
/// is written whole under another name and renamed, so a reader never sees half of one. Throws Error: UnknownFormat,
/// IndexOutOfRange, CannotWrite.
void write_mesh(const std::string& path, const Mesh& mesh, const std::vector<std::string>& comments = {});

}  // namespace gsp
