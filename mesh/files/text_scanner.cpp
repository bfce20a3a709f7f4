#include "mesh/files/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace gsp {

namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool is_line_end(char c) { return c == '\n' || c == '\r'; }

std::string_view without_plus(std::string_view token) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  return token;
}

}  // namespace

std::string quoted(std::string_view token) {
  constexpr std::size_t longest = 24;
  std::string text(token.substr(0, longest));
  if (token.size() > longest) text += "...";
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return '"' + text + '"';
}

bool parse_number(std::string_view token, double& value) {
  token = without_plus(token);
  const char* end = token.data() + token.size();
  const auto result = std::from_chars(token.data(), end, value);
  if (result.ptr != end || token.empty()) return false;
  // from_chars leaves the value alone out of range; strtod tells overflow from underflow.
  if (result.ec == std::errc::result_out_of_range) value = std::strtod(std::string(token).c_str(), nullptr);
  return result.ec == std::errc() || result.ec == std::errc::result_out_of_range;
}

bool parse_integer(std::string_view token, long long& value) {
  token = without_plus(token);
  const char* end = token.data() + token.size();
  const auto result = std::from_chars(token.data(), end, value);
  return !token.empty() && result.ptr == end && result.ec == std::errc();
}

void TextScanner::skip_space(bool within_line) {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (within_line && is_line_end(c)) return;
    if (comment_ != '\0' && c == comment_) {
      while (position_ < text_.size() && !is_line_end(text_[position_])) ++position_;
    } else if (is_space(c)) {
      ++position_;
    } else {
      return;
    }
  }
}

std::string_view TextScanner::next() {
  skip_space(false);
  token_ = position_;
  while (position_ < text_.size() && !is_space(text_[position_]) && (comment_ == '\0' || text_[position_] != comment_))
    ++position_;
  return text_.substr(token_, position_ - token_);
}

std::string_view TextScanner::next_in_line() {
  skip_space(true);
  if (position_ >= text_.size() || is_line_end(text_[position_])) return {};
  return next();
}

void TextScanner::skip_line() {
  while (position_ < text_.size() && !is_line_end(text_[position_])) ++position_;
  if (position_ < text_.size() && text_[position_] == '\r') ++position_;
  if (position_ < text_.size() && text_[position_] == '\n') ++position_;
}

double TextScanner::number() {
  const std::string_view token = next();
  double value;
  if (token.empty()) fail(Cause::Truncated, "the file ends where a number should be");
  if (!parse_number(token, value)) fail(Cause::Malformed, quoted(token) + " is not a number");
  return value;
}

long long TextScanner::integer() {
  const std::string_view token = next();
  long long value;
  if (token.empty()) fail(Cause::Truncated, "the file ends where a whole number should be");
  if (!parse_integer(token, value)) fail(Cause::Malformed, quoted(token) + " is not a whole number");
  return value;
}

int TextScanner::numbers_to_line_end() {
  int count = 0;
  for (std::string_view token = next_in_line(); !token.empty(); token = next_in_line(), ++count) {
    double value;
    if (!parse_number(token, value)) fail(Cause::Malformed, quoted(token) + " is not a number");
  }
  return count;
}

void TextScanner::require_end(const std::string& sentence) {
  if (const std::string_view token = next(); !token.empty())
    fail(Cause::Malformed, sentence + ", but " + quoted(token) + " follows");
}

bool TextScanner::at_end() {
  skip_space(false);
  return position_ >= text_.size();
}

long long TextScanner::line() const {
  long long line = 1;
  const std::size_t end = std::min(token_, text_.size());
  for (std::size_t i = 0; i < end; ++i)
    if (text_[i] == '\n' || (text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n'))) ++line;
  return line;
}

void TextScanner::fail(Cause cause, const std::string& sentence) const {
  throw Error(cause, sentence, Element::Line, line());
}

}  // namespace gsp
