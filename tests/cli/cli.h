#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "cli/run.h"

/// What a command printed and returned.
struct Ran {
  int status = 0;
  std::string out;
  std::string err;
};

inline Ran gsp_run(const std::vector<std::string>& args) {
  std::ostringstream out, err;
  Ran ran;
  ran.status = gsp::cli::run(args, out, err);
  ran.out = out.str();
  ran.err = err.str();
  return ran;
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
