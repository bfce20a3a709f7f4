#include "experiments/output/quoting.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gsp {

namespace {

// A character of UTF-8 and its bytes; no bytes where there is none.
struct Character {
  std::size_t bytes = 0;
  char32_t code = 0;
};

Character character_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[at + k]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {1, first};
  const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (first < 0xc2 || first > 0xf4 || at + bytes > text.size()) return {};
  char32_t code = first & (0x7fu >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xc0u) != 0x80u) return {};
    code = code << 6 | (byte(k) & 0x3fu);
  }
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code < kLeast[bytes] || surrogate || code > 0x10ffff ? Character{} : Character{bytes, code};
}

// What neither a terminal nor XML takes as a character: controls, line separators, marks that turn the direction of
// writing, and code points that stand for none.
bool shows(char32_t code) {
  const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
  const bool line_or_direction = (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return !control && !line_or_direction && (code & 0xfffe) != 0xfffe && !(code >= 0xfdd0 && code <= 0xfdef);
}

std::string escaped_byte(unsigned char byte) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  return {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
}

// FNV-1a, 64 bits (Fowler, Noll, Vo 1991), as digits.
std::string short_hash(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (unsigned char c : text) hash = (hash ^ c) * 0x100000001b3u;
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[hash >> shift & 15];
  return digits;
}

bool stands_in_file_name(char32_t code) {
  const bool alphanumeric =
      (code >= '0' && code <= '9') || (code >= 'A' && code <= 'Z') || (code >= 'a' && code <= 'z');
  return alphanumeric || code >= 0xa0 ||
         (code < 0x80 && std::string_view(" ._-+=@,~()").find(static_cast<char>(code)) != std::string_view::npos);
}

// The text with each of `special` put as `as` makes it.
template <class As>
std::string replaced(const std::string& text, std::string_view special, As as) {
  std::string result;
  for (char c : text)
    if (special.find(c) == std::string_view::npos)
      result += c;
    else
      result += as(c);
  return result;
}

}  // namespace

std::string printable(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const Character c = character_at(text, at);
    const std::size_t bytes = c.bytes == 0 ? 1 : c.bytes;
    if (c.bytes > 0 && shows(c.code))
      result.append(text, at, bytes);
    else
      for (std::size_t k = 0; k < bytes; ++k) result += escaped_byte(static_cast<unsigned char>(text[at + k]));
    at += bytes;
  }
  return result;
}

std::string file_stem(const std::string& name) {
  constexpr std::size_t kMostBytes = 100;
  std::string stem;
  for (std::size_t at = 0; at < name.size();) {
    const Character c = character_at(name, at);
    const std::size_t bytes = c.bytes == 0 ? 1 : c.bytes;
    const std::string kept =
        c.bytes > 0 && shows(c.code) && stands_in_file_name(c.code) ? name.substr(at, bytes) : std::string("_");
    if (stem.size() + kept.size() > kMostBytes) break;
    stem += kept;
    at += bytes;
  }
  // A dot in front hides a file, a dash looks like an option, and spaces at an end are lost on the way.
  if (stem.empty()) stem = "_";
  if (stem.front() == '.' || stem.front() == '-' || stem.front() == ' ') stem.front() = '_';
  if (stem.back() == ' ') stem.back() = '_';
  return stem == name ? stem : stem + '-' + short_hash(name);
}

std::string gnuplot_quoted(const std::string& text) {
  // Not in single quotes, where gnuplot 5.4 takes a quote at the beginning for the end. In double ones a backquote
  // would run commands; its octal number does not.
  const auto as = [](char c) { return c == '`' ? std::string("\\140") : std::string("\\") + c; };
  return '"' + replaced(printable(text), "\"\\`", as) + '"';
}

std::string gnuplot_field(const std::string& text) {
  // No escape brings a double quote into a field; two single ones look like it.
  return '"' + replaced(printable(text), "\"\\", [](char c) { return c == '"' ? "''" : "\\\\"; }) + '"';
}

std::string gnuplot_comment(const std::string& text) {
  return replaced(printable(text), "\\", [](char) { return '/'; });
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos && !text.starts_with("#")) return text;
  return '"' + replaced(text, "\"", [](char) { return "\"\""; }) + '"';
}

std::string xml_text(const std::string& text) {
  return replaced(printable(text), "&<>\"'", [](char c) {
    return c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : "&#39;";
  });
}

std::string json_in_html(const std::string& json) {
  return replaced(json, "<", [](char) { return "\\u003c"; });
}

std::string shell_word(const std::string& text) {
  return '\'' + replaced(text, "'", [](char) { return "'\\''"; }) + '\'';
}

}  // namespace gsp
