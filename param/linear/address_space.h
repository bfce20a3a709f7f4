#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>

namespace gsp {

/// Throws std::bad_alloc where the process could not map so many bytes now. OpenBLAS 0.3.21 asks for ever where the
/// system refuses, so who is about to call it asks first.
inline void require_address_space(std::size_t bytes) {
  void* const room = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  munmap(room, bytes);
}

}  // namespace gsp
