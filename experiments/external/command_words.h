#pragma once

#include <map>
#include <string>
#include <vector>

namespace gsp {

/// The words of a command line as a shell splits them: at spaces, outside of '...' and "..."; \ takes the next
/// character as it is outside of '...', and " or \ inside of "...". Nothing else of a shell is there: no variables,
/// patterns, pipes or redirections, so that no file name can become a command. Each {name} of `values` is replaced
/// inside its word, after the splitting. Throws Error(BadOption) for an open quote, an empty line, and braces around a
/// name that is not in `values`.
std::vector<std::string> command_words(const std::string& line, const std::map<std::string, std::string>& values);

}  // namespace gsp
