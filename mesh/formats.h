#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// The surface formats, behind `read_mesh` and `write_mesh`; public for tests and fuzzers that have bytes, not files.
enum class MeshFormat { Ply, Obj, Off, Stl };

/// By the name's ending, case-insensitive.
std::optional<MeshFormat> format_of(const std::string& path);

/// Parses the bytes of a whole file. Throws the errors of `read_mesh` except CannotOpen and UnknownFormat.
/// Memory stays under a small multiple of the bytes, whatever they claim.
Mesh parse_mesh(MeshFormat format, std::string_view bytes);

Mesh parse_ply_mesh(std::string_view bytes);
Mesh parse_obj(std::string_view bytes);
Mesh parse_off(std::string_view bytes);
Mesh parse_stl(std::string_view bytes);

/// Collects a file's polygons as fans of triangles from their first corner; polygons of fewer than three corners (wire
/// frames and points) carry no surface and are dropped.
class FanBuilder {
 public:
  explicit FanBuilder(Mesh& mesh) : mesh_(mesh) {}

  /// The mesh must have its vertices already. Throws Error: IndexOutOfRange with the number of the polygon in the file.
  void add(std::span<const long long> corners);

 private:
  Mesh& mesh_;
  long long polygon_ = 0;
};

/// Refuses to count past what an `int` can number (half-edges included). Throws Error: Malformed.
void require_countable(std::size_t vertices, std::size_t faces);

}  // namespace gsp
