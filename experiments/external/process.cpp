#include "experiments/external/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>

#include "mesh/error.h"

namespace gsp {

namespace {

constexpr rlim_t kMostFileBytes = rlim_t{4} << 30;
constexpr std::size_t kOutputBytes = 1 << 16, kTailBytes = 1 << 12;
constexpr int kLastLines = 3;
constexpr std::chrono::milliseconds kShortestPause(1), kLongestPause(50);

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

int open_log(const std::string& path) {
  const int number = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_APPEND | O_CLOEXEC, 0600);
  if (number < 0) throw Error(Cause::CannotWrite, "cannot write " + path + ": " + std::strerror(errno));
  return number;
}

void limit(int resource, rlim_t most) {
  rlimit now{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &now) != 0) return;
  now.rlim_cur = now.rlim_max = std::min(most, now.rlim_max);
  ::setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

// Between fork and exec of a program with threads: only what does not allocate.
[[noreturn]] void become(char* const* argv, const ProcessLimits& limits, int input, int output, int errors,
                         int failure) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGPIPE, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, kMostFileBytes);
  if (limits.megabytes) limit(RLIMIT_AS, static_cast<rlim_t>(*limits.megabytes * 1048576.0));
  if (::dup2(input, STDIN_FILENO) >= 0 && ::dup2(output, STDOUT_FILENO) >= 0 && ::dup2(errors, STDERR_FILENO) >= 0)
    ::execvp(argv[0], argv);
  const int why = errno;
  [[maybe_unused]] const ssize_t written = ::write(failure, &why, sizeof why);
  ::_exit(127);
}

// A started program; whatever is left of its group is ended with this.
class Child {
 public:
  Child(const std::vector<std::string>& words, const ProcessLimits& limits, int output, int errors) {
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const Descriptor input(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) refuse(words, errno);
    const Descriptor failure(ends[0]);
    Descriptor told(ends[1]);
    group_ = ::fork();
    if (group_ < 0) refuse(words, errno);
    if (group_ == 0) become(argv.data(), limits, input.number(), output, errors, ends[1]);
    ::setpgid(group_, group_);  // whichever of the two comes first
    told.close();
    int why = 0;
    ssize_t count;
    do count = ::read(failure.number(), &why, sizeof why);
    while (count < 0 && errno == EINTR);
    if (count != sizeof why) return;
    end();
    refuse(words, why);
  }
  ~Child() { end(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // True where it has ended; `status` as wait() has it.
  bool ended(int& status) {
    siginfo_t info{};
    if (::waitid(P_PID, static_cast<id_t>(group_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0)
      return false;
    end();
    status = status_;
    return true;
  }

 private:
  [[noreturn]] static void refuse(const std::vector<std::string>& words, int why) {
    throw Error(Cause::ToolMissing, "cannot start " + words.front() + ": " + std::strerror(why));
  }

  // As long as the program has not been waited for, its group is no other's.
  void end() {
    if (group_ <= 0) return;
    ::kill(-group_, SIGKILL);
    while (::waitpid(group_, &status_, 0) < 0 && errno == EINTR) {
    }
    group_ = 0;
  }

  pid_t group_ = 0;
  int status_ = 0;
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

}  // namespace

ProcessEnd run_process(const std::vector<std::string>& words, const ProcessLimits& limits, const std::string& folder,
                       const std::string& doing, Progress& progress) {
  using Clock = std::chrono::steady_clock;
  if (words.empty()) throw Error(Cause::BadOption, "an empty command");
  const std::string output = folder + "/stdout", errors = folder + "/stderr";
  ProcessEnd result;
  {
    const Descriptor output_file(open_log(output)), errors_file(open_log(errors));
    Child child(words, limits, output_file.number(), errors_file.number());
    const Clock::time_point start = Clock::now();
    int status = 0;
    double reported = -1.0;
    // Short programs are not waited for long.
    for (auto pause = kShortestPause; !child.ended(status); pause = std::min(2 * pause, kLongestPause)) {
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      if (seconds - reported >= 1.0) {
        progress.report(doing, std::min(seconds / limits.seconds, 1.0));
        reported = seconds;
      }
      if (seconds > limits.seconds) {
        result.timed_out = true;
        break;
      }
      std::this_thread::sleep_for(pause);
    }
    if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  }
  result.output = head(output);
  result.last_lines = last_lines(errors);
  if (result.last_lines.empty()) result.last_lines = last_lines(output);
  return result;
}

}  // namespace gsp
