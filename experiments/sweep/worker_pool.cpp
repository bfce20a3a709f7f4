#include "experiments/sweep/worker_pool.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>

#include "experiments/sweep/inbox.h"
#include "experiments/sweep/task_list.h"
#include "experiments/sweep/worker.h"
#include "experiments/version.h"
#include "mesh/atomic_file.h"
#include "mesh/memory.h"
#include "mesh/parallel.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kPollMilliseconds = 200;

// One worker and what it is at.
struct Running {
  Task task;
  double weight = 0.0;
  double memory = 0.0;
  std::size_t stages = 0;            ///< that it had to run
  std::set<std::string> unfinished;  ///< keys of those that it still has to
  std::string stage_key;             ///< the one in flight
  std::string doing;
  std::unique_ptr<Worker> worker;
};

class Pool {
 public:
  Pool(const std::string& folder, const Plan& plan, Store& store, const SweepOptions& options, Progress& progress)
      : folder_(folder), plan_(plan), store_(store), options_(options), progress_(progress) {
    const int cores = thread_count();
    jobs_ = options.jobs > 0 ? options.jobs : cores;
    waiting_ = outstanding_tasks(plan, store.results());
    for (const Task& task : waiting_) total_ += task_weight(plan, task);
    // The cores are shared out evenly; results do not depend on the number of threads.
    const int side_by_side = std::max(1, std::min(jobs_, static_cast<int>(waiting_.size())));
    threads_ = std::max(1, cores / side_by_side);
    make_folder(folder + "/tasks");
  }

  // Number of stages that ran.
  int run() {
    while (!stopped_ && (!waiting_.empty() || !running_.empty())) {
      while (may_start()) start();
      listen();
      take_results();
      report();
    }
    running_.clear();
    take_results();
    return stages_;
  }

 private:
  bool may_start() const {
    if (waiting_.empty() || static_cast<int>(running_.size()) >= jobs_) return false;
    if (running_.empty()) return true;
    double promised = task_memory_bytes(plan_, waiting_.front());
    for (const Running& running : running_) promised += running.memory;
    // What the workers at hand use already is no longer available, so this errs to the safe side.
    return promised <= available_memory();
  }

  void start() {
    Running running;
    running.task = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
    running.weight = task_weight(plan_, running.task);
    running.memory = task_memory_bytes(plan_, running.task);
    for (const PlannedCell& cell : running.task.cells)
      for (const auto& [kind, key] : cell.keys)
        if (!running.task.done.count(key)) running.unfinished.insert(key);
    running.stages = running.unfinished.size();
    const std::string path = fmt::format("{}/tasks/{}.json", folder_, started_++);
    write_task(path, running.task);
    running.worker = std::make_unique<Worker>(
        options_.program, std::vector<std::string>{"sweep-worker", "--store", folder_, "--task", path, "--parent",
                                                   std::to_string(::getpid()), "--threads", std::to_string(threads_)});
    running_.push_back(std::move(running));
  }

  // Waits a moment for lines of the workers, and settles those that have ended.
  void listen() {
    std::vector<pollfd> polled;
    for (const Running& running : running_) polled.push_back({running.worker->descriptor(), POLLIN, 0});
    ::poll(polled.data(), polled.size(), kPollMilliseconds);
    for (std::size_t i = 0; i < polled.size(); ++i) {
      if (polled[i].revents == 0) continue;
      for (const std::string& line : running_[i].worker->read_lines()) hear(running_[i], line);
    }
    for (std::size_t i = running_.size(); i-- > 0;)
      if (running_[i].worker->ended()) settle(i);
  }

  void hear(Running& running, const std::string& line) {
    const std::size_t space = line.find(' ');
    const std::string word = line.substr(0, space), rest = space == std::string::npos ? "" : line.substr(space + 1);
    if (word == "begin") running.stage_key = rest;
    if (word == "doing") running.doing = rest;
  }

  void settle(std::size_t index) {
    take_results();
    Running ended = std::move(running_[index]);
    running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(index));
    const WorkerEnd end = ended.worker->wait();
    if (end.signal == 0 && end.status == 0) return;
    if (end.signal == 0) throw Error(Cause::CannotWrite, fmt::format("a worker gave up with status {}", end.status));
    record_crash(ended, end.signal);
    requeue(ended.task);
  }

  // The stage that brought its worker down is a result like any other failure.
  void record_crash(const Running& ended, int signal) {
    for (const PlannedCell& cell : ended.task.cells)
      for (const auto& [kind, key] : cell.keys) {
        if (key != ended.stage_key) continue;
        StageResult crash;
        crash.key = key;
        crash.kind = kind;
        crash.options = options_json(cell.options, kind);
        crash.version = version();
        crash.cause = signal == SIGKILL ? "killed" : "crashed";
        crash.failure = fmt::format("its worker was ended by signal {} ({})", signal, ::strsignal(signal));
        note_failure(crash);
        store_.put({crash});
        return;
      }
    throw Error(Cause::Internal, fmt::format("a worker was ended by signal {} before its first stage", signal));
  }

  // The cells of a crashed worker that its crash does not settle.
  void requeue(const Task& task) {
    for (Task& left : outstanding_tasks(plan_, store_.results())) {
      std::erase_if(left.cells, [&](const PlannedCell& cell) {
        return std::none_of(task.cells.begin(), task.cells.end(),
                            [&](const PlannedCell& lost) { return lost.keys == cell.keys; });
      });
      if (left.cells.empty()) continue;
      waiting_.push_back(std::move(left));
    }
  }

  void take_results() {
    const std::vector<StageResult> results = empty_inbox(store_);
    stages_ += static_cast<int>(results.size());
    for (const StageResult& result : results) {
      for (Running& running : running_) running.unfinished.erase(result.key);
      if (result.failed()) note_failure(result);
    }
  }

  void note_failure(const StageResult& result) {
    progress_.note(fmt::format("FAILED ({}): {}", result.cause, result.failure));
    stopped_ = stopped_ || options_.fail_fast;
  }

  // The share of the work that is done; a running task counts by the stages that it has finished.
  void report() {
    double left_weight = 0.0;
    for (const Task& task : waiting_) left_weight += task_weight(plan_, task);
    for (const Running& running : running_)
      left_weight += running.weight * static_cast<double>(running.unfinished.size()) /
                     static_cast<double>(std::max<std::size_t>(1, running.stages));
    const double fraction = total_ > 0.0 ? std::clamp(1.0 - left_weight / total_, 0.0, 1.0) : 1.0;
    std::string doing;
    for (const Running& running : running_)
      doing += fmt::format("{}{}: {}", doing.empty() ? "" : ", ", running.task.cells.front().model, running.doing);
    const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    const std::string left = fraction > 0.0 && fraction < 1.0
                                 ? fmt::format(", about {:.0f} s left", seconds * (1.0 - fraction) / fraction)
                                 : "";
    progress_.report(fmt::format("{} running, {} waiting{} ({})", running_.size(), waiting_.size(), left, doing),
                     fraction);
  }

  const std::string& folder_;
  const Plan& plan_;
  Store& store_;
  const SweepOptions& options_;
  Progress& progress_;
  std::vector<Task> waiting_;
  std::vector<Running> running_;
  Clock::time_point begun_ = Clock::now();
  double total_ = 0.0;
  int jobs_ = 1, threads_ = 1, started_ = 0, stages_ = 0;
  bool stopped_ = false;
};

}  // namespace

int run_in_workers(const Plan& plan, Store& store, const SweepOptions& options, Progress& progress) {
  const int stages = Pool(store.folder(), plan, store, options, progress).run();
  fs::remove_all(store.folder() + "/tasks");
  return stages;
}

}  // namespace gsp
