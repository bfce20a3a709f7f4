#pragma once

#include <cstddef>
#include <functional>

#include "mesh/export.h"

namespace GSP_PUBLIC gsp {

/// Number of threads that `parallel_for` uses; 0 asks for all cores. It holds for the whole process, TBB's other users
/// included, so the program or a test sets it once and the library never does.
void set_thread_count(int threads);
int thread_count();

/// Calls body(begin, end) on consecutive blocks of `grain` indices that cover [0, count), on several threads.
/// Block borders depend on `grain` alone, so a body that writes only to its own indices, or to one slot per block
/// (begin / grain), gives the same bits for any number of threads. Where bodies throw, the exception of the lowest
/// block is rethrown here, whichever came first in time; later blocks may not have run.
void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace gsp
