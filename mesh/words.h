#pragma once

#include <string>
#include <vector>

#include "mesh/error.h"

namespace gsp {

// The words of an enumeration. `values` is an array of all of them that stands beside the enumeration, `name` the
// function that names one; every enumeration that a file or a command line names has both and an inverse, `X_of`.

/// The names of all values, in their order.
template <class Values, class Name>
std::vector<std::string> words_of(const Values& values, Name name) {
  std::vector<std::string> words;
  for (auto value : values) words.emplace_back(name(value));
  return words;
}

/// The value with that name. Throws Error(BadOption): "unknown `what` WORD".
template <class Values, class Name>
auto value_of(const Values& values, Name name, const std::string& word, const char* what) {
  for (auto value : values)
    if (word == name(value)) return value;
  throw Error(Cause::BadOption, std::string("unknown ") + what + ' ' + word);
}

}  // namespace gsp
