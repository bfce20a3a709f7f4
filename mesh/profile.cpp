#include "mesh/profile.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>

#include "mesh/memory.h"

namespace gsp {

namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void begin_peak() { std::ofstream("/proc/self/clear_refs") << '5'; }  // proc(5)

}  // namespace

double process_cpu_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  rusage children{};
  ::getrusage(RUSAGE_CHILDREN, &children);
  double seconds = static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  for (const timeval& part : {children.ru_utime, children.ru_stime})
    seconds += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
  return seconds;
}

/// What memory was at most since the last call belongs to every step under way.
void Profile::take_peak() {
  if (!open_.empty()) {
    const double peak = 1e-6 * peak_memory();
    for (const Open& open : open_) {
      double& most = nodes_[open.node].step.peak_megabytes;
      most = std::max(most, peak);
    }
  }
  begin_peak();
}

Profile::Scope Profile::step(const std::string& name) {
  take_peak();
  std::vector<int>& siblings = open_.empty() ? outermost_ : nodes_[open_.back().node].inside;
  const auto known =
      std::find_if(siblings.begin(), siblings.end(), [&](int node) { return nodes_[node].step.name == name; });
  int node = static_cast<int>(nodes_.size());
  if (known != siblings.end()) {
    node = *known;
  } else {
    siblings.push_back(node);
    Node fresh;
    fresh.step.name = name;
    fresh.step.depth = static_cast<int>(open_.size());
    nodes_.push_back(std::move(fresh));
  }
  open_.push_back({node, wall_seconds(), process_cpu_seconds()});
  return Scope(this);
}

void Profile::end() {
  const Open& last = open_.back();
  ProfileStep& step = nodes_[last.node].step;
  ++step.runs;
  step.seconds += wall_seconds() - last.wall;
  step.cpu_seconds += process_cpu_seconds() - last.cpu;
  take_peak();
  open_.pop_back();
}

void Profile::list(const std::vector<int>& nodes, std::vector<ProfileStep>& all) const {
  for (int node : nodes) {
    all.push_back(nodes_[node].step);
    list(nodes_[node].inside, all);
  }
}

std::vector<ProfileStep> Profile::steps() const {
  std::vector<ProfileStep> all;
  list(outermost_, all);
  return all;
}

}  // namespace gsp
