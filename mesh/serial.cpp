#include <algorithm>

#include "mesh/parallel.h"

// What parallel.cpp does, on the calling thread and without TBB: for decoders on machines that have no such library.
namespace gsp {

void set_thread_count(int) {}

int thread_count() { return 1; }

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  for (std::size_t begin = 0; begin < count; begin += grain) body(begin, std::min(count, begin + grain));
}

}  // namespace gsp
