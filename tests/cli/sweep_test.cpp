#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli.h"
#include "temporary_folder.h"

using nlohmann::json;

namespace {

std::string recipe(const TemporaryFolder& folder, const std::string& text) {
  std::ofstream(folder.file("r.toml")) << "models = [\"shape:torus\"]\n" << text;
  return folder.file("r.toml");
}

}  // namespace

TEST_CASE("a dry run lists the cells and makes nothing") {
  const TemporaryFolder folder;
  const std::string store = folder.file("store");
  const std::string file = recipe(folder, "method = [\"gsp\", \"draco\"]\ngamma = [0, 2]\n");
  const Ran ran = gsp_run({"sweep", file, "--store", store, "--dry-run"});
  CHECK(ran.status == 0);
  CHECK(contains(ran.out, "waiting  torus"));
  CHECK(contains(ran.out, "gsp gamma=0"));
  CHECK(contains(ran.out, "3 cells: 0 done, 0 failed, 3 waiting"));
  const json report = json::parse(gsp_run({"sweep", file, "--store", store, "--status", "--json"}).out);
  CHECK(report["waiting"] == 3);
  CHECK(report["sweep_at_work"] == false);
  CHECK_FALSE(std::filesystem::exists(store));
}

TEST_CASE("a recipe is refused with its line and status 2, one that is no TOML or not there with status 3") {
  const TemporaryFolder folder;
  const std::string store = folder.file("store");
  const Ran unknown = gsp_run({"sweep", recipe(folder, "gama = 1\n"), "--store", store});
  CHECK(unknown.status == 2);
  CHECK(contains(unknown.err, "did you mean gamma?"));
  CHECK(contains(unknown.err, "line 2"));
  CHECK(gsp_run({"sweep", recipe(folder, "gamma = = 1\n"), "--store", store}).status == 3);
  CHECK(gsp_run({"sweep", folder.file("none.toml"), "--store", store}).status == 3);
  CHECK(gsp_run({"sweep", recipe(folder, ""), "--store", store, "--models", "shape:tours"}).status == 2);
  CHECK_FALSE(std::filesystem::exists(store));
}

TEST_CASE("what reads a store refuses a folder without one") {
  const TemporaryFolder folder;
  const std::string run = folder.path().string(), output = folder.file("out");
  CHECK(gsp_run({"baseline", run, "-o", output}).status == 3);
  CHECK(gsp_run({"check", run, "--baseline", output}).status == 3);
  CHECK(gsp_run({"export", run, "-o", output}).status == 3);
  CHECK_FALSE(std::filesystem::exists(output));
}
