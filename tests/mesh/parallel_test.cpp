#include "mesh/parallel.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "mesh/error.h"

using namespace gsp;

TEST_CASE("of several exceptions that of the lowest block is rethrown, whichever comes first in time") {
  for (int threads : {1, 2, 4}) {
    CAPTURE(threads);
    set_thread_count(threads);
    for (int run = 0; run < 20; ++run) {
      std::string message;
      try {
        parallel_for(64, 1, [](std::size_t begin, std::size_t) {
          // Block 3 is slow, so that blocks behind it throw before it.
          if (begin == 3) std::this_thread::sleep_for(std::chrono::milliseconds(2));
          if (begin >= 3) throw Error(Cause::Malformed, "block " + std::to_string(begin));
        });
      } catch (const Error& error) {
        message = error.what();
      }
      CHECK(message == "block 3");
    }
  }
  set_thread_count(0);
}

TEST_CASE("every block runs once, at any number of threads") {
  for (int threads : {1, 2, 4}) {
    set_thread_count(threads);
    std::atomic<int> sum = 0;
    parallel_for(1000, 7, [&](std::size_t begin, std::size_t end) { sum += static_cast<int>(end - begin); });
    CHECK(sum == 1000);
  }
  set_thread_count(0);
}
