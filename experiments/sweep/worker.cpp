#include "experiments/sweep/worker.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "mesh/error.h"

extern char** environ;

namespace gsp {

Worker::Worker(const std::string& program, const std::vector<std::string>& arguments) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw Error(Cause::ToolMissing, std::string("cannot start a worker: ") + std::strerror(errno));
  // In a process group of its own, so that Ctrl-C reaches the sweep alone, which then decides.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const int failure = ::posix_spawnp(&pid_, program.c_str(), &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ::close(ends[1]);
  output_ = ends[0];
  if (failure == 0) return;
  ::close(output_);
  throw Error(Cause::ToolMissing, "cannot start " + program + ": " + std::strerror(failure));
}

Worker::~Worker() {
  kill();
  wait();
  ::close(output_);
}

std::vector<std::string> Worker::read_lines() {
  char buffer[4096];
  ssize_t count;
  do count = ::read(output_, buffer, sizeof buffer);
  while (count < 0 && errno == EINTR);
  closed_ = count <= 0;
  if (count > 0) partial_.append(buffer, static_cast<std::size_t>(count));
  std::vector<std::string> lines;
  std::size_t start = 0;
  for (std::size_t end; (end = partial_.find('\n', start)) != std::string::npos; start = end + 1)
    lines.push_back(partial_.substr(start, end - start));
  partial_.erase(0, start);
  return lines;
}

WorkerEnd Worker::wait() {
  WorkerEnd end;
  if (pid_ == 0) return end;
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = 0;
  if (WIFEXITED(status)) end.status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

void Worker::kill() {
  if (pid_ != 0) ::kill(pid_, SIGKILL);
}

void end_with_parent(long parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // The parent may have ended before the request was made.
  if (::getppid() != parent) ::_exit(1);
}

}  // namespace gsp
