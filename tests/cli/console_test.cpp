#include "cli/console.h"

#include <catch2/catch.hpp>
#include <sstream>

using namespace gsp;

TEST_CASE("away from a terminal progress is plain lines, few of them") {
  std::ostringstream err;
  {
    cli::Console console(err);
    Progress progress = console.progress();
    for (int i = 0; i < 1000; ++i) progress.report("solve", i / 1000.0);
  }
  CHECK(err.str() == "solve 0%\n");
}

TEST_CASE("quiet leaves nothing but errors") {
  std::ostringstream err;
  cli::Console console(err);
  console.quiet = true;
  Progress progress = console.progress();
  progress.report("solve", 0.5);
  progress.note("a remark");
  console.say("a sentence");
  CHECK(err.str().empty());
  console.error("gsp: it failed");
  CHECK(err.str() == "gsp: it failed\n");
}

TEST_CASE("a flood of remarks is cut and counted") {
  std::ostringstream err;
  {
    cli::Console console(err);
    Progress progress = console.progress();
    for (int i = 0; i < 100; ++i) progress.note("remark " + std::to_string(i));
  }
  CHECK(err.str().find("remark 9\n") != std::string::npos);
  CHECK(err.str().find("remark 10\n") == std::string::npos);
  CHECK(err.str().find("90 more remarks") != std::string::npos);
}
