#include "experiments/external/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>

#include "mesh/error.h"

namespace gsp {

namespace {

constexpr rlim_t kMostFileBytes = rlim_t{4} << 30;
constexpr std::size_t kOutputBytes = 1 << 16, kTailBytes = 1 << 12;
constexpr int kLastLines = 3;
constexpr double kSecondsBetweenReports = 1.0;

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw Error(Cause::ToolMissing, std::string("cannot make a pipe: ") + std::strerror(errno));
  }
};

int open_log(const std::string& path) {
  const int number = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_APPEND | O_CLOEXEC, 0600);
  if (number < 0) throw Error(Cause::CannotWrite, "cannot write " + path + ": " + std::strerror(errno));
  return number;
}

// What the guard and the program before its start tell.
struct Message {
  enum Kind : int { NotStarted, Ended } kind;
  int value;  // errno; or the status as waitpid has it
};

// Everything that is needed between fork and exec, where nothing may allocate: other threads may hold any lock.
struct Start {
  char* const* argv;
  const char* folder;
  rlim_t address_space;  // RLIM_INFINITY for none
  int input, output, errors, lifeline, report;
};

void tell(int report, Message message) {
  [[maybe_unused]] const ssize_t written = ::write(report, &message, sizeof message);
}

void limit(int resource, rlim_t most) {
  rlimit now{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &now) != 0) return;
  now.rlim_cur = now.rlim_max = std::min(most, now.rlim_max);
  ::setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

[[noreturn]] void become_program(const Start& start) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, kMostFileBytes);
  if (start.address_space != RLIM_INFINITY) limit(RLIMIT_AS, start.address_space);
  if (::chdir(start.folder) == 0) ::execvp(start.argv[0], start.argv);
  tell(start.report, {Message::NotStarted, errno});
  ::_exit(127);
}

// Starts the program in this process' group, and ends the group when the program has ended or the lifeline breaks,
// which it does when the process at its other end is gone.
[[noreturn]] void guard(const Start& start) {
  ::setpgid(0, 0);
  for (const int number : {SIGINT, SIGTERM, SIGPIPE, SIGCHLD, SIGXFSZ}) ::signal(number, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(start.input, STDIN_FILENO);
  ::dup2(start.output, STDOUT_FILENO);
  ::dup2(start.errors, STDERR_FILENO);
  // Nothing else stays open here that somebody might wait for.
  const int low = std::min(start.lifeline, start.report), high = std::max(start.lifeline, start.report);
  if (low > 3) ::close_range(3, low - 1, 0);
  if (high > low + 1) ::close_range(low + 1, high - 1, 0);
  ::close_range(high + 1, ~0U, 0);
  const pid_t program = ::fork();
  if (program == 0) become_program(start);
  if (program < 0) {
    tell(start.report, {Message::NotStarted, errno});
    ::_exit(127);
  }
  // By its number: glibc 2.36 declares the function for C alone.
  const int ended = static_cast<int>(::syscall(SYS_pidfd_open, program, 0));
  pollfd waits[2] = {{ended, POLLIN, 0}, {start.lifeline, POLLIN, 0}};
  while (::poll(waits, 2, -1) < 0 && errno == EINTR) {
  }
  int status = 0;
  if (waits[0].revents != 0 && ::waitpid(program, &status, 0) == program) tell(start.report, {Message::Ended, status});
  ::kill(0, SIGKILL);
  ::_exit(127);
}

// A guarded program; whatever is left of its group is ended with this.
class Child {
 public:
  Child(const std::vector<std::string>& words, const ProcessLimits& limits, const std::string& folder, int output,
        int errors) {
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const Descriptor input(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    const Pipe lifeline, report;
    const Descriptor guards_lifeline(lifeline.ends[0]), guards_report(report.ends[1]);
    lifeline_ = lifeline.ends[1];
    report_ = report.ends[0];
    const rlim_t space = limits.megabytes ? static_cast<rlim_t>(*limits.megabytes * 1048576.0) : RLIM_INFINITY;
    const Start start{
        argv.data(),           folder.c_str(), space, input.number(), output, errors, guards_lifeline.number(),
        guards_report.number()};
    group_ = ::fork();
    if (group_ == 0) guard(start);
    if (group_ < 0) {
      const int why = errno;
      end();
      throw Error(Cause::ToolMissing, "cannot start " + words.front() + ": " + std::strerror(why));
    }
    ::setpgid(group_, group_);  // whichever of the two comes first
  }
  ~Child() { end(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // What is told within so many seconds; a guard that somebody ended tells of that signal.
  std::optional<Message> told(double seconds) {
    pollfd wait{report_, POLLIN, 0};
    if (::poll(&wait, 1, static_cast<int>(std::ceil(1000.0 * seconds))) <= 0) return std::nullopt;
    Message message{Message::Ended, SIGKILL};
    ssize_t count;
    do count = ::read(report_, &message, sizeof message);
    while (count < 0 && errno == EINTR);
    return message;
  }

 private:
  // As long as the guard has not been waited for, its group is no other's.
  void end() {
    if (group_ > 0) {
      ::kill(-group_, SIGKILL);
      while (::waitpid(group_, nullptr, 0) < 0 && errno == EINTR) {
      }
      group_ = 0;
    }
    for (int* number : {&lifeline_, &report_}) {
      if (*number >= 0) ::close(*number);
      *number = -1;
    }
  }

  pid_t group_ = 0;
  int lifeline_ = -1, report_ = -1;
};

std::string head(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text(kOutputBytes, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::string last_lines(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - static_cast<std::streamoff>(kTailBytes)));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    // What a terminal would obey, and what no sentence needs.
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    line.erase(0, line.find_first_not_of(' '));
    if (!line.empty()) lines.push_back(line);
  }
  std::string text;
  for (std::size_t i = lines.size() - std::min<std::size_t>(lines.size(), kLastLines); i < lines.size(); ++i)
    text += (text.empty() ? "" : " | ") + lines[i];
  return text;
}

// Waits for the program's end or its time limit. Throws Error(ToolMissing, Cancelled).
ProcessEnd watch(Child& child, const std::string& program, double most_seconds, const std::string& doing,
                 Progress& progress) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  ProcessEnd result;
  for (;;) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (seconds >= most_seconds) {
      result.timed_out = true;
      return result;
    }
    progress.report(doing, seconds / most_seconds);
    const std::optional<Message> message = child.told(std::min(kSecondsBetweenReports, most_seconds - seconds));
    if (!message) continue;
    if (message->kind == Message::NotStarted)
      throw Error(Cause::ToolMissing, "cannot start " + program + ": " + std::strerror(message->value));
    if (WIFEXITED(message->value)) result.status = WEXITSTATUS(message->value);
    if (WIFSIGNALED(message->value)) result.signal = WTERMSIG(message->value);
    return result;
  }
}

}  // namespace

ProcessEnd run_process(const std::vector<std::string>& words, const ProcessLimits& limits, const std::string& folder,
                       const std::string& doing, Progress& progress) {
  if (words.empty()) throw Error(Cause::BadOption, "an empty command");
  const std::string output = folder + "/stdout", errors = folder + "/stderr";
  ProcessEnd result;
  {
    const Descriptor output_file(open_log(output)), errors_file(open_log(errors));
    Child child(words, limits, folder, output_file.number(), errors_file.number());
    result = watch(child, words.front(), limits.seconds, doing, progress);
  }
  result.output = head(output);
  result.last_lines = last_lines(errors);
  if (result.last_lines.empty()) result.last_lines = last_lines(output);
  return result;
}

}  // namespace gsp
