#pragma once

#include <utility>

#include "mesh/parallel.h"

/// What `make()` gives on one thread and what on two; afterwards all cores again, as before any test, also where it
/// throws.
template <class Make>
auto by_one_and_two_threads(const Make& make) {
  struct AllAgain {
    ~AllAgain() { gsp::set_thread_count(0); }
  } const all_again;
  gsp::set_thread_count(1);
  auto one = make();
  gsp::set_thread_count(2);
  auto two = make();
  return std::pair(std::move(one), std::move(two));
}
