#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli.h"
#include "temporary_folder.h"
#include "test_meshes.h"

namespace fs = std::filesystem;

TEST_CASE("every bad file gives a result, or a named error with status 3, in good time") {
  const std::string shared = shared_meshes();
  if (shared.empty()) return;
  const TemporaryFolder folder;
  const std::string map = folder.file("map.param.ply");
  for (const fs::directory_entry& entry : fs::directory_iterator(shared + "/bad")) {
    const std::string path = entry.path().string();
    CAPTURE(path);
    const auto start = std::chrono::steady_clock::now();

    const Ran info = gsp_run({"info", path, "--json"});
    CHECK((info.status == 0 || info.status == 3));
    const auto report = nlohmann::json::parse(info.out);
    CHECK(report["usable"] == (info.status == 0));
    if (info.status == 3) CHECK(report["refusal"]["cause"].is_string());

    // What info calls usable may still fail in the map, but not silently and not with a file left behind.
    fs::remove(map);
    const Ran made = gsp_run({"parameterize", path, "-o", map, "--check", "--quiet"});
    CAPTURE(made.err);
    if (info.status == 3) CHECK(made.status == 3);
    else CHECK(made.status == 0);
    CHECK(fs::exists(map) == (made.status == 0));
    if (made.status != 0) CHECK(made.err.rfind("gsp: ", 0) == 0);

    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    CHECK(seconds.count() < 60.0);
  }
}
