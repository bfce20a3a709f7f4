#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "cli.h"
#include "mesh/io.h"
#include "mesh/read_file.h"
#include "mesh/shapes.h"
#include "temporary_folder.h"

using namespace gsp;
namespace fs = std::filesystem;

namespace {

// Files of each kind that commands read, none of them what it is called: outputs are refused before anything is read.
struct Inputs {
  TemporaryFolder folder;
  std::string place(const std::string& name) const { return folder.file(name); }
  Inputs() {
    for (const char* name : {"s.off", "m.param.ply", "r.sr.ply", "c.pgc", "other.ply", "b.json", "recipe.toml"})
      std::ofstream(place(name)) << "kept";
    fs::create_directory(place("run"));
    std::ofstream(place("run/results.sqlite")) << "kept";
    std::ofstream(place("run/curve.csv")) << "kept";
    fs::create_symlink("r.sr.ply", place("link.ply"));
    fs::create_hard_link(place("r.sr.ply"), place("hard.ply"));
    fs::create_directory_symlink(".", place("here"));
  }
  bool kept() const {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path()))
      if (entry.is_regular_file() && read_file(entry.path().string()) != "kept") return false;
    return true;
  }
};

int shell_status(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("an output that is an input is refused with status 2 before anything is read, by every command") {
  const Inputs in;
  const auto at = [&](const std::string& name) { return in.place(name); };
  for (const std::vector<std::string>& args : std::vector<std::vector<std::string>>{
           {"parameterize", at("other.ply"), "-o", at("other.ply")},
           {"parameterize", at("other.ply"), "-o", at("here/other.ply")},
           {"parameterize", at("other.ply"), "-o", at("m.param.ply"), "--omega-csv", at("m.param.ply")},
           {"remesh", at("m.param.ply"), "-o", at("m.param.ply")},
           {"remesh", at("r.sr.ply"), "-o", at("link.ply")},
           {"remesh", at("link.ply"), "-o", at("r.sr.ply")},
           {"remesh", at("r.sr.ply"), "-o", at("hard.ply")},
           {"encode", at("c.pgc"), "-o", at("c.pgc")},
           {"decode", at("r.sr.ply"), "-o", at("hard.ply")},
           {"play", at("c.pgc"), "-o", at("c.pgc")},
           {"distance", at("other.ply"), at("r.sr.ply"), "--per-vertex", at("other.ply")},
           {"distance", at("other.ply"), at("r.sr.ply"), "--per-vertex", at("r.sr.ply")},
           {"distortion", at("m.param.ply"), "--picture", at("m.param.ply")},
           {"distortion", at("m.param.ply"), "--per-face", at("x.csv"), "--picture", at("here/m.param.ply")},
           {"baseline", at("run"), "-o", at("run/results.sqlite")},
           {"check", at("run"), "--baseline", at("b.json"), "--junit", at("b.json")},
           {"report", at("run"), "-o", at("run")},
           {"report", at("run"), "-o", at("here/run/.")},
           {"export", at("run"), "-o", at("run")}}) {
    CAPTURE(args);
    const Ran ran = gsp_run(args);
    CHECK(ran.status == 2);
    CHECK(contains(ran.err, "gsp: "));
    CHECK(in.kept());
  }
}

TEST_CASE("an ending that denies the content is refused; others and none are taken") {
  const Inputs in;
  const auto status = [&](std::vector<std::string> args, const std::string& option, const std::string& output) {
    args.insert(args.end(), {option, in.place(output)});
    return gsp_run(args).status;
  };
  const std::string map = in.place("m.param.ply");
  for (const char* output : {"x.obj", "x.OFF", "x.stl", "x.pgc", "x.png"}) {
    CHECK(status({"parameterize", map}, "-o", output) == 2);
    CHECK(status({"remesh", map}, "-o", output) == 2);
    CHECK(status({"decode", map}, "-o", output) == 2);
    CHECK(status({"distance", map, map}, "--per-vertex", output) == 2);
  }
  CHECK(status({"encode", map}, "-o", "x.ply") == 2);
  CHECK(status({"remesh", map}, "-o", "x.glb") == 2);
  CHECK(status({"decode", map}, "-o", "x.gltf") == 2);
  CHECK(status({"decode", map, "--levels"}, "-o", "x.ply") == 2);
  CHECK(status({"play", map}, "-o", "x.ply") == 2);
  CHECK(status({"picture", map}, "-o", "x.jpg") == 2);
  CHECK(status({"picture", map}, "-o", "x.svg") == 2);
  CHECK(status({"distortion", map}, "--per-face", "x.json") == 2);
  CHECK(status({"baseline", in.place("run")}, "-o", "x.csv") == 2);
  // These go on to read, and find that the files are none.
  for (const char* output : {"x", "x.PLY", "x.map"}) CHECK(status({"remesh", map}, "-o", output) == 3);
  CHECK(status({"encode", map}, "-o", "x.bin") == 3);
  CHECK(status({"decode", map}, "-o", "x.GLB") == 3);
}

TEST_CASE("a place that cannot be written is told before anything is read, with status 1") {
  const Inputs in;
  const std::string map = in.place("m.param.ply");
  CHECK(gsp_run({"remesh", map, "-o", in.place("no/such/x.ply")}).status == 1);
  CHECK(gsp_run({"remesh", map, "-o", in.place("run")}).status == 1);
  CHECK(gsp_run({"remesh", map, "-o", ""}).status == 2);
  for (const std::vector<std::string>& args :
       std::vector<std::vector<std::string>>{{"curve", map, "-o", in.place("b.json")},
                                             {"report", in.place("run"), "-o", in.place("b.json")},
                                             {"export", in.place("run"), "-o", in.place("b.json/inside")},
                                             {"sweep", in.place("recipe.toml"), "--store", in.place("b.json")}}) {
    const Ran ran = gsp_run(args);
    CAPTURE(args, ran.err);
    CHECK(ran.status == 1);
    CHECK_FALSE(contains(ran.err, "filesystem error"));
  }
  CHECK(in.kept());
}

TEST_CASE("standard output that is full or closed is a failure, and no file takes its place") {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("s.ply"), map = folder.file("m.param.ply"), program = "'" GSP_PROGRAM "' ",
                    errors = " 2>'" + folder.file("err") + "'";
  write_mesh(mesh, shapes::octahedron());
  for (const std::string& arguments :
       {std::string("--version"), std::string("--help"), std::string("curve --help"), "info '" + mesh + "'",
        "info --json '" + mesh + "'", "distance --samples 1000 '" + mesh + "' '" + mesh + "'"}) {
    CAPTURE(arguments);
    CHECK(shell_status(program + arguments + " >/dev/full" + errors) == 1);
    CHECK(contains(read_file(folder.file("err")), "standard output cannot be written"));
    CHECK(shell_status(program + arguments + " >&-" + errors) == 1);
    CHECK(shell_status(program + arguments + " >/dev/null" + errors) == 0);
  }
  const std::string made = program + "parameterize --quiet '" + mesh + "' -o '" + map + "'";
  REQUIRE(shell_status(made + " >/dev/null" + errors) == 0);
  const std::string whole = read_file(map);
  fs::remove(map);
  CHECK(shell_status(made + " <&- >&- 2>&-") == 1);
  CHECK(read_file(map) == whole);
}

TEST_CASE("a link as output is followed by the commands") {
  const TemporaryFolder folder;
  write_mesh(folder.file("s.ply"), shapes::octahedron());
  fs::create_symlink("real.param.ply", folder.path() / "link.param.ply");
  REQUIRE(gsp_run({"parameterize", folder.file("s.ply"), "-o", folder.file("link.param.ply"), "--quiet"}).status == 0);
  CHECK(fs::is_symlink(folder.path() / "link.param.ply"));
  CHECK(fs::file_size(folder.file("real.param.ply")) > 100);
}

TEST_CASE("the tolerance of Hausdorff bounds is refused before anything is read, as its help says") {
  CHECK(contains(gsp_run({"distance", "--help"}).out, "0 or 1e-06 to 1"));
  for (const char* value : {"1e-7", "-1", "2", "nan"})
    CHECK(gsp_run({"distance", "missing-a.ply", "missing-b.ply", "--hausdorff-tolerance", value}).status == 2);
  for (const char* value : {"0", "1e-6", "1"})
    CHECK(gsp_run({"distance", "missing-a.ply", "missing-b.ply", "--hausdorff-tolerance", value}).status == 3);
}
