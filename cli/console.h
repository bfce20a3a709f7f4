#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

#include "mesh/progress.h"

namespace gsp::cli {

/// Makes the first Ctrl-C ask the running stage to stop, and the second end the program at once.
void catch_interrupts();
/// Keeps the places of standard input, output and error where one of them was closed, so that no file that is opened
/// later comes to stand for it. What is written to an output that was closed fails.
void hold_standard_streams();
/// True once Ctrl-C was pressed.
bool interrupted();

/// What people see while a command runs, on standard error: on a terminal one line that is written over, elsewhere a
/// plain line now and then.
class Console {
 public:
  explicit Console(std::ostream& err);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  bool quiet = false;    ///< nothing but errors
  bool verbose = false;  ///< every remark of every stage, not only the first few
  int memory_limit = 0;  ///< megabytes that the process may hold whenever a stage reports, 0 for any

  /// Reports here, cancels after Ctrl-C, and throws Error(OutOfMemory) above `memory_limit`. Valid as long as the
  /// console.
  Progress progress();
  /// A line for people.
  void say(const std::string& sentence);
  /// The same, also when quiet.
  void error(const std::string& sentence);

 private:
  using Clock = std::chrono::steady_clock;
  void show(const std::string& stage, double fraction);
  void remark(const std::string& sentence);
  void require_memory(const std::string& stage) const;
  void clear_line();

  std::ostream& err_;
  bool terminal_;
  bool line_open_ = false;
  std::string stage_;
  Clock::time_point shown_{};
  int remarks_ = 0;
};

}  // namespace gsp::cli
