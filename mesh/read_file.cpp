#include "mesh/read_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "mesh/error.h"

namespace gsp {

std::string read_file(const std::string& path) {
  const auto fail = [&](const std::string& reason) -> std::string {
    throw Error(Cause::CannotOpen, "cannot open " + path + ": " + reason);
  };
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (code) return fail(code.message());
  // A device or pipe may never end.
  if (status.type() != std::filesystem::file_type::regular) return fail("not a regular file");
  std::ifstream in(path, std::ios::binary);
  if (!in) return fail(std::strerror(errno));
  const auto size = std::filesystem::file_size(path, code);
  if (code) return fail(code.message());
  std::string bytes;
  try {
    bytes.resize(size);
  } catch (const std::exception&) {
    return fail(std::to_string(size) + " bytes do not fit into memory");
  }
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

std::string_view without_byte_order_mark(std::string_view text) {
  using namespace std::string_view_literals;
  if (text.starts_with("\xef\xbb\xbf"sv)) return text.substr(3);
  if (text.starts_with("\xff\xfe"sv) || text.starts_with("\xfe\xff"sv) || text.starts_with("\0\0\xfe\xff"sv))
    throw Error(Cause::UnknownFormat, "the text is in UTF-16 or UTF-32; UTF-8 and ASCII are read", Element::Byte, 0);
  return text;
}

std::string read_text(const std::string& path) {
  const std::string bytes = read_file(path);
  return std::string(without_byte_order_mark(bytes));
}

}  // namespace gsp
