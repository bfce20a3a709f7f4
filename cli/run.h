#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace gsp::cli {

/// Exit status of a run that Ctrl-C ended, as shells have it (128 + SIGINT).
inline constexpr int kInterruptedStatus = 130;

/// The command line as a function: `args` without the program's name, data to `out`, chatter and errors to `err`.
/// Returns the exit status: 0 done, 1 failed, 2 wrong usage, 3 unusable input, 130 interrupted. Never throws.
int run(const std::vector<std::string>& args, std::ostream& out, std::ostream& err);

}  // namespace gsp::cli
