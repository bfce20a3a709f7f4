#include "experiments/figures/image.h"

#include <algorithm>

namespace gsp {

Image side_by_side(const std::vector<Image>& images) {
  Image result;
  for (const Image& image : images) {
    result.width += image.width;
    result.height = std::max(result.height, image.height);
  }
  result.rgb.assign(static_cast<std::size_t>(3) * result.width * result.height, 255);
  int left = 0;
  for (const Image& image : images) {
    const int top = (result.height - image.height) / 2;
    for (int y = 0; y < image.height; ++y)
      std::copy_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(3) * y * image.width, 3 * image.width,
                  result.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(top + y) * result.width + left));
    left += image.width;
  }
  return result;
}

}  // namespace gsp
