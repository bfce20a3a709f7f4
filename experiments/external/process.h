#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/progress.h"

namespace gsp {

struct ProcessLimits {
  double seconds = 3600.0;               ///< wall time, positive
  std::optional<double> megabytes = {};  ///< address space of each of its processes; none: as this process may
};

/// What a program that has ended leaves.
struct ProcessEnd {
  int status = 0;          ///< exit status
  int signal = 0;          ///< that ended it, 0 where none did
  bool timed_out = false;  ///< it was ended at its time limit
  std::string output;      ///< the first 64 KB of its standard output
  /// The last three lines that it wrote to its standard error or, where there are none, to its standard output.
  std::string last_lines;

  bool succeeded() const { return status == 0 && signal == 0 && !timed_out; }
};

/// Runs `words`, a program (a path, or a name to look up) and its arguments, without a shell, and waits for its end.
/// It and all that it starts are a process group, of which nothing is left afterwards, nor when this process ends in
/// whatever way before it: a guard process waits for both. It works in `folder` (absolute), has no standard input, and
/// may write no file over 4 GB; what it prints goes to files there meanwhile. `doing` names it in the progress, which
/// is asked once a second. Throws Error: ToolMissing where it cannot be started, CannotWrite, Cancelled.
ProcessEnd run_process(const std::vector<std::string>& words, const ProcessLimits& limits, const std::string& folder,
                       const std::string& doing, Progress& progress);

}  // namespace gsp
