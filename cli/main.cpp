#include <malloc.h>

#include <iostream>

#include "cli/console.h"
#include "cli/run.h"

namespace {

/// Freed memory that the program keeps. Its algorithms take and free the same tens of megabytes over and over, and
/// each time the kernel would have to clear them: 7% of the time of a map.
constexpr int kKeptBytes = 256 << 20;

}  // namespace

int main(int argc, char** argv) {
  mallopt(M_TRIM_THRESHOLD, kKeptBytes);
  mallopt(M_MMAP_THRESHOLD, kKeptBytes / 8);
  mallopt(M_TOP_PAD, kKeptBytes / 16);
  gsp::cli::hold_standard_streams();
  gsp::cli::catch_interrupts();
  return gsp::cli::run({argv + 1, argv + argc}, std::cout, std::cerr);
}
