#pragma once

#include <cstddef>
#include <functional>

namespace gsp {

/// Number of threads that `parallel_for` uses; 0 asks for all cores. Set once, by main or a test.
void set_thread_count(int threads);
int thread_count();

/// Calls body(begin, end) on consecutive blocks of `grain` indices that cover [0, count), on several threads.
/// Block borders depend on `grain` alone, so a body that writes only to its own indices, or to one slot per block
/// (begin / grain), gives the same bits for any number of threads. An exception in a body is rethrown here.
void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace gsp
