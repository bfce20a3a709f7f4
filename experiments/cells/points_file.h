#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gsp {

/// One point that somebody measured elsewhere.
struct ForeignPoint {
  std::string model;
  std::optional<int> vertices;  ///< of the surface, where the file says it
  std::size_t bytes = 0;
  double psnr_db = 0.0;
  std::string label;  ///< the setting it was made with
  std::string note;   ///< such as what the bytes hold
};

/// Reads a CSV file (RFC 4180) with the columns model, bytes, psnr_db and, where they are, label and note, in any
/// order; `vertices`, where it is, must be the count of the surface that it speaks of, so that another of the same name
/// does not get them. PSNR is taken against the diagonal of the input's bounding box, as everywhere here; bytes are
/// what the note says. Lines that begin with # are comments. Throws Error(CannotOpen, Malformed) with the line.
std::vector<ForeignPoint> read_points_file(const std::string& path);

}  // namespace gsp
