#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gsp {

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// One column of an element: every value in double, which holds each PLY type exactly.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float64;
  std::optional<PlyType> count_type;  ///< of a list's lengths; empty for a scalar property
  std::vector<double> values;         ///< row after row
  std::vector<std::size_t> starts;    ///< lists only: #rows + 1; row r is values[starts[r]] .. values[starts[r + 1]]

  bool is_list() const { return count_type.has_value(); }
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;  ///< rows
  std::vector<PlyProperty> properties;

  /// Null where there is none of that name; a list is not found as a scalar, nor a scalar as a list.
  const PlyProperty* scalar(std::string_view property) const;
  const PlyProperty* list(std::string_view property) const;
};

/// A whole PLY file, whatever its elements are. A surface's meaning of it is in files/ply_mesh.cpp; a
/// parameterization's is in param/.
struct PlyDocument {
  std::vector<std::string> comments;  ///< without the keyword and the space after it
  std::vector<PlyElement> elements;

  const PlyElement* find(std::string_view element) const;
};

/// Parses PLY: ASCII and binary of both byte orders, both spellings of the type names, any elements and properties.
/// Counts are held against the bytes that are left before memory is taken, so memory stays under 16 times the bytes.
/// Throws Error: Malformed, Truncated (with the line of a header or ASCII file, or the byte of a binary one).
PlyDocument parse_ply(std::string_view bytes);

/// `read_file` and `parse_ply`.
PlyDocument read_ply(const std::string& path);

/// Writes binary little-endian PLY with each property in its own type. Lists need `starts`. Line breaks in comments
/// become spaces.
void write_ply(std::ostream& out, const PlyDocument& document);

}  // namespace gsp
