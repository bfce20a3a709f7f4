#pragma once

#include <string>
#include <string_view>

namespace gsp {

/// The bytes of a regular file. Throws Error(CannotOpen) with the system's reason.
std::string read_file(const std::string& path);

/// The text without the byte order mark of UTF-8 that some editors put before it. Throws Error(UnknownFormat) for the
/// marks of UTF-16 and UTF-32.
std::string_view without_byte_order_mark(std::string_view text);

/// The text of a regular file, without the mark. Throws the errors of both.
std::string read_text(const std::string& path);

}  // namespace gsp
