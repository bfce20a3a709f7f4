#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli.h"
#include "temporary_folder.h"
#include "test_meshes.h"

namespace fs = std::filesystem;

namespace {

// The program itself, in a process of its own: neither a crash nor a hang (status 124) takes the test with it.
Ran gsp_process(const std::string& arguments, const TemporaryFolder& folder) {
  const std::string out = folder.file("out.txt"), err = folder.file("err.txt");
  const int status =
      std::system(("timeout 60 '" GSP_PROGRAM "' " + arguments + " >'" + out + "' 2>'" + err + "'").c_str());
  const auto text = [](const std::string& path) {
    std::ifstream in(path);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out), text(err)};
}

}  // namespace

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
