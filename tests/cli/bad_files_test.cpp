#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "process.h"
#include "temporary_folder.h"
#include "test_meshes.h"

namespace fs = std::filesystem;

TEST_CASE("every bad file is reported on: usable, or a named cause with status 3") {
  const std::string shared = shared_meshes();
  if (shared.empty()) return;
  const TemporaryFolder folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(shared + "/bad")) {
    const std::string file = entry.path().string();
    CAPTURE(file);
    const Ran info = gsp_process("info '" + file + "' --json", folder);
    CAPTURE(info.err);
    REQUIRE((info.status == 0 || info.status == 3));
    const auto report = nlohmann::json::parse(info.out);
    CHECK(report["usable"] == (info.status == 0));
    if (info.status == 3) CHECK(report["refusal"]["cause"].is_string());
  }
}

TEST_CASE("every usable bad file is parameterized, in good time", "[slow]") {
  const std::string shared = shared_meshes();
  if (shared.empty()) return;
  const TemporaryFolder folder;
  const std::string map = folder.file("map.param.ply");
  for (const fs::directory_entry& entry : fs::directory_iterator(shared + "/bad")) {
    const std::string file = entry.path().string();
    CAPTURE(file);
    const Ran info = gsp_process("info '" + file + "' --json", folder);
    const Ran made = gsp_process("parameterize '" + file + "' -o '" + map + "' --check --quiet", folder);
    CAPTURE(made.err);
    CHECK(made.status == info.status);
    CHECK(fs::exists(map) == (made.status == 0));
    if (made.status != 0) CHECK(made.err.rfind("gsp: ", 0) == 0);
    fs::remove(map);
  }
}
