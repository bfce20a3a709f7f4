#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace gsp {

/// Base64 (RFC 4648, with padding), as a page holds bytes. O(bytes).
std::string base64(std::span<const std::uint8_t> bytes);
std::string base64(std::string_view bytes);

}  // namespace gsp
