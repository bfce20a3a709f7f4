#include "mesh/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

namespace gsp {

namespace {

std::unique_ptr<tbb::global_control> control;

// The exception of the first block that threw, by the blocks' order and not by time. Blocks behind it need not run any
// more; those before it do, since they may throw too.
class FirstFailure {
 public:
  explicit FirstFailure(std::size_t blocks) : block_(blocks) {}
  bool is_before(std::size_t block) const { return block_.load(std::memory_order_relaxed) < block; }
  void record(std::size_t block, std::exception_ptr failure) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_before(block)) return;
    block_ = block;
    failure_ = std::move(failure);
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::atomic<std::size_t> block_;
  std::exception_ptr failure_;
  std::mutex mutex_;
};

}  // namespace

void set_thread_count(int threads) {
  control.reset();
  if (threads > 0)
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

int thread_count() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t blocks = (count + grain - 1) / grain;
  if (blocks <= 1 || thread_count() == 1) {
    for (std::size_t b = 0; b < blocks; ++b) body(b * grain, std::min(count, (b + 1) * grain));
    return;
  }
  FirstFailure first(blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    if (first.is_before(b)) return;
    try {
      body(b * grain, std::min(count, (b + 1) * grain));
    } catch (...) {
      first.record(b, std::current_exception());
    }
  });
  first.rethrow();
}

}  // namespace gsp
