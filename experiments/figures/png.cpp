#include <png.h>

#include <vector>

#include "experiments/figures/image.h"
#include "mesh/atomic_file.h"
#include "mesh/error.h"

namespace gsp {

void write_png(const std::string& path, const Image& image) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  std::vector<char> bytes(PNG_IMAGE_PNG_SIZE_MAX(header));
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr))
    throw Error(Cause::CannotWrite, path + ": " + header.message);
  write_file(path, {bytes.data(), size});
}

}  // namespace gsp
