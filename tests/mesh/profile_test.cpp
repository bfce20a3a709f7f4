#include "mesh/profile.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "mesh/progress.h"

using namespace gsp;

TEST_CASE("steps of one name inside the same step are one, each followed by those inside it") {
  Profile profile;
  {
    const auto whole = profile.step("whole");
    for (int run = 0; run < 2; ++run) {
      const auto first = profile.step("first");
      const auto inner = profile.step("inner");
    }
    { const auto second = profile.step("second"); }
    { const auto inner = profile.step("inner"); }
    { const auto first = profile.step("first"); }
  }
  std::vector<std::string> names;
  std::vector<int> depths, runs;
  for (const ProfileStep& s : profile.steps()) {
    names.push_back(s.name);
    depths.push_back(s.depth);
    runs.push_back(s.runs);
  }
  CHECK(names == std::vector<std::string>{"whole", "first", "inner", "second", "inner"});
  CHECK(depths == std::vector<int>{0, 1, 2, 1, 1});
  CHECK(runs == std::vector<int>{1, 3, 2, 1, 1});
}

TEST_CASE("a step's times hold those of the steps inside it; a pause costs wall seconds and no CPU") {
  Profile profile;
  {
    const auto whole = profile.step("whole");
    {
      const auto pause = profile.step("pause");
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    const auto work = profile.step("work");
    const double start = process_cpu_seconds();
    while (process_cpu_seconds() < start + 0.05) {
    }
  }
  const std::vector<ProfileStep> steps = profile.steps();
  REQUIRE(steps.size() == 3);
  const ProfileStep &whole = steps[0], &pause = steps[1], &work = steps[2];
  CHECK(pause.seconds >= 0.05);
  CHECK(pause.cpu_seconds < 0.025);
  CHECK(work.cpu_seconds >= 0.05);
  CHECK(whole.seconds >= pause.seconds + work.seconds);
  CHECK(whole.cpu_seconds >= pause.cpu_seconds + work.cpu_seconds);
}

TEST_CASE("a step's peak is that of the memory in use while it ran") {
  constexpr std::size_t kBytes = 64'000'000;
  Profile profile;
  {
    const auto whole = profile.step("whole");
    { const auto before = profile.step("before"); }
    {
      const auto large = profile.step("large");
      std::vector<char> bytes(kBytes, 1);
      const auto inner = profile.step("inner");
    }
    { const auto after = profile.step("after"); }
  }
  const std::vector<ProfileStep> steps = profile.steps();
  REQUIRE(steps.size() == 5);
  const double before = steps[1].peak_megabytes, large = steps[2].peak_megabytes, inner = steps[3].peak_megabytes;
  CHECK(before > 0.0);
  CHECK(large >= before + 0.9e-6 * kBytes);
  CHECK(inner >= before + 0.9e-6 * kBytes);
  constexpr double kOwn = 1.0;  // megabytes that the runtime takes between steps, a sanitizer's above all
  CHECK(std::abs(steps[0].peak_megabytes - large) < kOwn);
  CHECK(steps[4].peak_megabytes < large + kOwn);
}

TEST_CASE("a progress times its steps where it has a profile, and so does one within it") {
  Progress progress;
  { const auto nowhere = progress.step("before"); }
  Profile profile;
  progress.set_profile(&profile);
  Progress inner = progress.within("horse");
  { const auto here = inner.step("inside"); }
  progress.set_profile(nullptr);
  { const auto nowhere = progress.step("behind"); }
  REQUIRE(profile.steps().size() == 1);
  CHECK(profile.steps().front().name == "inside");
}
