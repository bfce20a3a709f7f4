#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace gsp {

/// How a worker ended.
struct WorkerEnd {
  int status = 0;  ///< exit status
  int signal = 0;  ///< that ended it, 0 where none did
};

/// A child process that writes lines to its standard output. Destroying it kills it.
class Worker {
 public:
  /// Starts `program` (a path, or a name to look up) with arguments. Throws Error(ToolMissing).
  Worker(const std::string& program, const std::vector<std::string>& arguments);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Where its lines come from, for poll().
  int descriptor() const { return output_; }
  /// Takes in what has been written; the complete lines of it, without line breaks. Ends where it has closed its
  /// output.
  std::vector<std::string> read_lines();
  bool ended() const { return closed_; }
  /// Waits for its end.
  WorkerEnd wait();
  void kill();

 private:
  pid_t pid_ = 0;
  int output_ = -1;
  bool closed_ = false;
  std::string partial_;
};

/// Makes this process end with its parent, which has the given process id, however that ends.
void end_with_parent(long parent);

}  // namespace gsp
