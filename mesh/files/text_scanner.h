#pragma once

#include <string>
#include <string_view>

#include "mesh/error.h"

namespace gsp {

/// The whole token as a number: decimal, with or without sign and exponent, "nan", "inf". Overflow gives an infinity,
/// underflow 0. False where it is anything else. Independent of the locale.
bool parse_number(std::string_view token, double& value);
bool parse_integer(std::string_view token, long long& value);

/// A token for messages: in quotes, hostile text cut short and made printable.
std::string quoted(std::string_view token);

/// Walks over the tokens of a text file, white space apart. A `comment` character, if given, hides the rest of its
/// line. A carriage return is white space, so all three line-ending conventions read alike.
class TextScanner {
 public:
  explicit TextScanner(std::string_view text, char comment = '\0', std::size_t position = 0)
      : text_(text), comment_(comment), position_(position) {}

  /// The next token on any line; empty at the end of the text.
  std::string_view next();
  /// The next token on the current line; empty where the line has no more.
  std::string_view next_in_line();
  /// Goes to the start of the next line.
  void skip_line();
  /// Moves the end of the last token back by `count` characters, so that they are read again.
  void put_back(std::size_t count) { position_ -= count; }

  /// The next token on any line as a number. Throws Error: Truncated, Malformed, with the line.
  double number();
  long long integer();

  /// Steps over the line's further tokens and counts those that are numbers. Throws Error(Malformed) for any that is
  /// not.
  int numbers_to_line_end();
  /// Throws Error(Malformed) with the line where anything but white space is left. `sentence`: what should end here.
  void require_end(const std::string& sentence);

  bool at_end();
  std::size_t left() const { return text_.size() - position_; }
  /// The line of the last token, from 1. O(bytes before it): for messages only.
  long long line() const;
  [[noreturn]] void fail(Cause cause, const std::string& sentence) const;

 private:
  void skip_space(bool within_line);

  std::string_view text_;
  char comment_;
  std::size_t position_;
  std::size_t token_ = 0;
};

}  // namespace gsp
