#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/progress.h"

namespace gsp {

struct ProcessLimits {
  double seconds = 3600.0;               ///< wall time
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
/// It and all that it starts are a process group, of which nothing is left afterwards; it ends when this process does.
/// It has no standard input, and may write no file over 4 GB. Its output is kept in files of `folder` meanwhile.
/// `doing` names it in the progress. Throws Error: ToolMissing where it cannot be started, CannotWrite, Cancelled.
ProcessEnd run_process(const std::vector<std::string>& words, const ProcessLimits& limits, const std::string& folder,
                       const std::string& doing, Progress& progress);

}  // namespace gsp
