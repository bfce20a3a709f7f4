#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gsp {

/// One point that somebody measured elsewhere.
struct ForeignPoint {
  std::string model;
  std::optional<int> vertices, faces;  ///< of the surface, where the file says it
  std::size_t bytes = 0;
  double psnr_db = 0.0;
  std::string measured_on;  ///< another model, of the same kind, if it is not `model` that was measured
  std::string label;        ///< the setting it was made with
  std::string note;         ///< such as what the bytes hold

  /// Whether it speaks of a surface: by its counts where the file has some, whatever the surface is called, since two
  /// share a name more often than counts; else by its name.
  bool is_of(const std::string& name, int vertex_count, int face_count) const;
};

/// Reads a CSV file (RFC 4180) with the columns model, bytes, psnr_db and, where they are, vertices, faces,
/// measured_on, label and note, in any order. PSNR is taken against the diagonal of the input's bounding box, of the
/// larger RMS of both directions, as everywhere here; bytes are what the note says. Lines that begin with # are
/// comments. Throws Error(CannotOpen, Malformed) with the line.
std::vector<ForeignPoint> read_points_file(const std::string& path);

}  // namespace gsp
