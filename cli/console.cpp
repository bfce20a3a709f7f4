#include "cli/console.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <iostream>

#include "experiments/output/quoting.h"
#include "mesh/memory.h"

namespace gsp::cli {

namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

extern "C" void on_interrupt(int) {
  interrupt_seen = 1;
  std::signal(SIGINT, SIG_DFL);
}

constexpr int kRemarksShown = 10;

}  // namespace

void catch_interrupts() { std::signal(SIGINT, on_interrupt); }

void hold_standard_streams() {
  // `open` takes the lowest free number. Reading only, so that writing fails as it did when the stream was closed.
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) < 0) return;
}

bool interrupted() { return interrupt_seen != 0; }

Console::Console(std::ostream& err) : err_(err), terminal_(&err == &std::cerr && ::isatty(STDERR_FILENO) == 1) {}

Console::~Console() {
  clear_line();
  if (remarks_ > kRemarksShown && !verbose && !quiet)
    err_ << "... and " << remarks_ - kRemarksShown << " more remarks (--verbose shows them)\n";
}

Progress Console::progress() {
  Progress progress([this](const std::string& stage, double fraction) {
    show(stage, fraction);
    require_memory(stage);
    return !interrupted();
  });
  progress.on_note([this](const std::string& sentence) { remark(sentence); });
  return progress;
}

void Console::say(const std::string& sentence) {
  if (!quiet) error(sentence);
}

void Console::error(const std::string& sentence) {
  clear_line();
  err_ << printable(sentence) << '\n';
}

void Console::remark(const std::string& sentence) {
  if (++remarks_ <= kRemarksShown || verbose) say(sentence);
}

void Console::show(const std::string& stage, double fraction) {
  if (quiet) return;
  using namespace std::chrono_literals;
  const auto now = Clock::now();
  const bool new_stage = stage != stage_;
  // A terminal line may change often; a log should gain a line for a stage that lasts, not one for every report.
  const auto pause = terminal_ ? 100ms : new_stage ? 1000ms : 10000ms;
  if (shown_ != Clock::time_point{} && now - shown_ < pause) return;
  shown_ = now;
  stage_ = stage;
  const std::string text = fmt::format("{} {:.0f}%", printable(stage), 100.0 * fraction);
  if (terminal_) {
    err_ << "\r\033[K" << text << std::flush;
    line_open_ = true;
  } else {
    err_ << text << '\n' << std::flush;
  }
}

void Console::require_memory(const std::string& stage) const {
  if (memory_limit == 0) return;
  const double megabytes = 1e-6 * resident_memory();
  if (megabytes > memory_limit)
    throw Error(Cause::OutOfMemory, fmt::format("{:.0f} MB of memory are taken, more than --memory-limit {}, during {}",
                                                megabytes, memory_limit, stage));
}

void Console::clear_line() {
  if (line_open_) err_ << "\r\033[K" << std::flush;
  line_open_ = false;
}

}  // namespace gsp::cli
