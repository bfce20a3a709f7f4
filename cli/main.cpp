#include <iostream>

#include "cli/console.h"
#include "cli/run.h"

int main(int argc, char** argv) {
  gsp::cli::hold_standard_streams();
  gsp::cli::catch_interrupts();
  return gsp::cli::run({argv + 1, argv + argc}, std::cout, std::cerr);
}
