#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace gsp {

/// Red, green, blue in [0, 1], as a display takes them (sRGB).
using Colour = Eigen::Array3d;

/// Rows from the top, three bytes a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Writes PNG of 8 bits a channel, whole and then renamed; the same bytes for the same image.
/// Throws Error(CannotWrite).
void write_png(const std::string& path, const Image& image);

/// The images from left to right on white, centred in height.
Image side_by_side(const std::vector<Image>& images);

}  // namespace gsp
