#include "mesh/parallel.h"

#include <algorithm>
#include <memory>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

namespace gsp {

namespace {
std::unique_ptr<tbb::global_control> control;
}

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
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) { body(b * grain, std::min(count, (b + 1) * grain)); });
}

}  // namespace gsp
