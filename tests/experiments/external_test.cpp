#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "cause_of.h"
#include "coder/anchors.h"
#include "experiments/external/command_words.h"
#include "experiments/external/external_tool.h"
#include "experiments/external/points_file.h"
#include "experiments/external/process.h"
#include "experiments/external/run_tool.h"
#include "mesh/io.h"
#include "mesh/shapes.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

using Words = std::vector<std::string>;

class Runs {
 public:
  ProcessEnd of(const std::string& script, const ProcessLimits& limits = {.seconds = 20.0}) const {
    Progress silent;
    return run_process({"sh", "-c", script}, limits, folder_.path().string(), "test", silent);
  }
  std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  TemporaryFolder folder_;
};

// Whether the process whose number a file holds ends within two seconds.
bool ends(const std::string& file) {
  pid_t process = 0;
  for (int i = 0; i < 200; ++i) {
    std::ifstream(file) >> process;
    if (process > 0 && ::kill(process, 0) != 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

ExternalTool codec(const std::string& encode, const std::string& decode) {
  ExternalTool tool;
  tool.name = "tool";
  tool.encode = encode;
  tool.decode = decode;
  tool.values = {""};
  tool.time_limit = 10.0;
  return tool;
}

// The points of a codec on a sphere.
std::vector<CodedSurface> coded(const ExternalTool& tool, const Mesh& surface = shapes::sphere(2)) {
  const TemporaryFolder folder;
  Progress silent;
  std::vector<CodedSurface> points;
  run_codec(tool, surface, folder.path().string(), silent,
            [&](CodedSurface point) { points.push_back(std::move(point)); });
  CHECK(std::filesystem::is_empty(folder.path()));
  return points;
}

std::string message(const ExternalTool& tool) {
  try {
    coded(tool);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

bool installed(const char* program) {
  if (std::filesystem::exists(std::string("/usr/bin/") + program)) return true;
  WARN(program << " is not installed: its rows are not compared");
  return false;
}

}  // namespace

TEST_CASE("a command line is words and nothing else of a shell") {
  CHECK(command_words("a  b\tc", {}) == Words{"a", "b", "c"});
  CHECK(command_words(R"(a 'b c' "d 'e' \" \\ \n" f\ g '' x'y'z)", {}) ==
        Words{"a", "b c", "d 'e' \" \\ \\n", "f g", "", "xyz"});
  CHECK(command_words("a; b | c > $d `e` * ~", {}) == Words{"a;", "b", "|", "c", ">", "$d", "`e`", "*", "~"});
  // What is put in is never split, nor read again.
  CHECK(command_words("run {in} --to={out}.x", {{"in", "a b; 'c' {out}"}, {"out", "$(d)"}}) ==
        Words{"run", "a b; 'c' {out}", "--to=$(d).x"});
  for (const char* bad : {"", "  ", "a 'b", "a \"b", "a {c}", "a {}"})
    CHECK(cause_of([&] { command_words(bad, {{"in", ""}}); }) == Cause::BadOption);
}

TEST_CASE("a process ends with its status, its signal, or at its time limit, and tells its last words") {
  const Runs run;
  const ProcessEnd good = run.of("echo one; echo two");
  CHECK(good.succeeded());
  CHECK(good.output == "one\ntwo\n");
  CHECK(good.last_lines == "one | two");
  const ProcessEnd bad = run.of("for i in 1 2 3 4 5; do echo \"line $i\" >&2; done; echo out; exit 7");
  CHECK(bad.status == 7);
  CHECK(bad.last_lines == "line 3 | line 4 | line 5");
  CHECK(run.of("kill -SEGV $$").signal == SIGSEGV);
  const auto start = std::chrono::steady_clock::now();
  const ProcessEnd late = run.of("echo begun >&2; sleep 60", {.seconds = 0.3});
  CHECK(late.timed_out);
  CHECK(late.last_lines == "begun");
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
  Progress silent;
  CHECK(cause_of([&] { run_process({"no-such-program-anywhere"}, {}, run.file("."), "test", silent); }) ==
        Cause::ToolMissing);
  CHECK(run.of("cat").succeeded());  // there is nothing to read
  CHECK(run.of("touch left; pwd -P").output == std::filesystem::canonical(run.file(".")).string() + "\n");
}

TEST_CASE("a process has no more memory than its limit") {
#if defined(__SANITIZE_ADDRESS__)
  WARN("AddressSanitizer needs its address space");
#else
  const Runs run;
  const char* takes_200_mb = "exec python3 -c 'x = bytearray(200 << 20)'";
  if (!run.of("command -v python3").succeeded()) return;
  CHECK(run.of(takes_200_mb).succeeded());
  CHECK_FALSE(run.of(takes_200_mb, {.seconds = 20.0, .megabytes = 150.0}).succeeded());
#endif
}

TEST_CASE("nothing of a process' group is left after its end, a time limit or an interrupt") {
  const Runs run;
  const std::string leaves = "(sleep 100 & echo $! > pid; wait) & while [ ! -s pid ]; do sleep 0.01; done; ";
  CHECK(run.of(leaves).succeeded());
  CHECK(ends(run.file("pid")));
  std::filesystem::remove(run.file("pid"));
  CHECK(run.of(leaves + "sleep 100", {.seconds = 1.0}).timed_out);
  CHECK(ends(run.file("pid")));
  std::filesystem::remove(run.file("pid"));
  Progress interrupt([&](const std::string&, double) { return !std::filesystem::exists(run.file("pid")); });
  CHECK(cause_of([&] {
          run_process({"sh", "-c", leaves + "sleep 100"}, {}, run.file("."), "test", interrupt);
        }) == Cause::Cancelled);
  CHECK(ends(run.file("pid")));
}

TEST_CASE("a process' group ends with the process that runs it, however that ends") {
  const Runs run;
  const pid_t worker = ::fork();
  if (worker == 0) {
    run.of("(sleep 100 & echo $! > pid; wait) & sleep 100", {});
    ::_exit(0);
  }
  while (!std::filesystem::exists(run.file("pid"))) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(worker, SIGKILL);
  ::waitpid(worker, nullptr, 0);
  CHECK(ends(run.file("pid")));
}

TEST_CASE("a codec's bytes are the file's, and its surface is the one decoded") {
  // Copies are lossless codecs of so many bytes.
  ExternalTool copy = codec("cp {input} {output}", "cp {input} {output}");
  const std::vector<CodedSurface> points = coded(copy);
  REQUIRE(points.size() == 1);
  CHECK(points[0].decoded.faces == shapes::sphere(2).faces);
  // Header; 12 bytes a vertex, 13 a face.
  CHECK(points[0].bytes > 12 * 162 + 13 * 320);
  CHECK(points[0].bytes < 12 * 162 + 13 * 320 + 300);
  copy.input = copy.output = "obj";
  CHECK(coded(copy)[0].decoded.positions == shapes::sphere(2).positions);
}

TEST_CASE("a command that hangs, crashes, writes nothing or garbage is an error with its cause") {
  const std::string copy = "cp {input} {output}";
  ExternalTool hangs = codec("sh -c 'echo still here >&2; sleep 100'", copy);
  hangs.time_limit = 0.3;
  CHECK(cause_of([&] { coded(hangs); }) == Cause::TimedOut);
  CHECK(says(message(hangs), "was still running after 0.3 s: still here"));
  const ExternalTool crashes = codec(copy, "sh -c 'echo oh no >&2; kill -SEGV $$'");
  CHECK(cause_of([&] { coded(crashes); }) == Cause::ToolFailed);
  CHECK(says(message(crashes), "signal 11"));
  CHECK(says(message(crashes), "oh no"));
  CHECK(says(message(codec("sh -c 'exit 3'", copy)), "ended with status 3"));
  CHECK(cause_of([&] { coded(codec("true", copy)); }) == Cause::ToolFailed);
  CHECK(says(message(codec("true", copy)), "wrote no output"));
  CHECK(cause_of([&] { coded(codec("touch {output}", copy)); }) == Cause::ToolFailed);
  CHECK(cause_of([&] { coded(codec("mkdir {output}", copy)); }) == Cause::ToolFailed);
  CHECK(cause_of([&] { coded(codec("no-such-program-anywhere {output}", copy)); }) == Cause::ToolMissing);
  const ExternalTool garbage = codec(copy, "sh -c 'echo garbage > \"$1\"' x {output}");
  CHECK(cause_of([&] { coded(garbage); }) == Cause::Malformed);
  CHECK(says(message(garbage), "what tool wrote"));
  ExternalTool no_number =
      codec(copy, "sh -c 'printf \"OFF\\n3 1 0\\n0 0 0\\n1 0 0\\n0 1 nan\\n3 0 1 2\\n\" > \"$1\"' x {output}");
  no_number.output = "off";
  CHECK(cause_of([&] { coded(no_number); }) == Cause::NonFinite);
  ExternalTool no_face = codec(copy, "sh -c 'printf \"OFF\\n1 0 0\\n0 0 0\\n\" > \"$1\"' x {output}");
  no_face.output = "off";
  CHECK(cause_of([&] { coded(no_face); }) == Cause::NoFaces);
}

TEST_CASE("a remesher's output is a semi-regular mesh, its levels recovered") {
  const TemporaryFolder folder;
  Progress silent;
  ExternalTool tool;
  tool.name = "copy";
  tool.kind = ExternalTool::Kind::Remesher;
  tool.remesh = "cp {input} {output}";
  tool.values = {"3"};
  // An icosahedron, quadrisected three times.
  const SemiregularMesh mesh = run_remesher(tool, shapes::sphere(3), folder.path().string(), silent);
  CHECK(mesh.level == 3);
  CHECK(mesh.base_faces.size() == 20);
  CHECK(cause_of([&] { run_remesher(tool, shapes::tetrahedron(), folder.path().string(), silent); }) ==
        Cause::NoSubdivisionConnectivity);
}

TEST_CASE("a table of a recipe is a codec, remeshers or points") {
  const auto tools = [](const std::string& json) { return external_tools(json, "/recipes"); };
  const std::string codec = R"("name": "d", "encode": "e {value}", "decode": "f")";
  const std::vector<ExternalTool> one = tools("{" + codec + R"(, "values": [7, 7.5, "x-1", 7], "time_limit": 5})");
  REQUIRE(one.size() == 1);
  CHECK(one[0].values == Words{"7", "7.5", "x-1"});
  CHECK(one[0].time_limit == 5.0);
  const std::vector<ExternalTool> two = tools(R"({"name": "r", "remesh": "r {value}", "values": [17, 33]})");
  REQUIRE(two.size() == 2);
  CHECK(two[1].name == "r-33");
  CHECK(two[1].values == Words{"33"});
  CHECK(tools(R"({"name": "p", "points": "{folder}/p.csv"})")[0].points == "/recipes/p.csv");
  const ExternalTool again = external_from_json(external_json(one[0]));
  CHECK(external_json(again) == external_json(one[0]));
  // Limits and places decide on no result.
  ExternalTool elsewhere = one[0];
  elsewhere.folder = "/elsewhere";
  elsewhere.time_limit = 6.0;
  CHECK(external_key_json(elsewhere) == external_key_json(one[0]));
  elsewhere.version = "2";
  CHECK(external_key_json(elsewhere) != external_key_json(one[0]));
  for (const std::string& bad :
       {std::string(R"({"name": "d"})"), "{" + codec + "}", "{" + codec + R"(, "values": []})",
        "{" + codec + R"(, "values": ["a b"]})", "{" + codec + R"(, "values": [1], "time_limit": 0})",
        "{" + codec + R"(, "values": [1], "memory_limit": "x"})", "{" + codec + R"(, "values": [1], "remesh": "r"})",
        "{" + codec + R"(, "values": [1], "input": "txt"})", std::string(R"({"name": "d", "encode": "e"})"),
        std::string(R"({"encode": "e", "decode": "f"})"), std::string(R"({"name": "a/b", "points": "p"})"),
        std::string(R"({"name": "d", "encode": "e {x}", "decode": "f"})"),
        std::string(R"({"name": "d", "encode": "e", "decode": "f", "values": [1]})"), std::string("[]"),
        std::string("{")})
    CHECK(cause_of([&] { tools(bad); }) == Cause::BadOption);
}

TEST_CASE("points measured elsewhere belong to the surface of their counts, or of their name") {
  const TemporaryFolder folder;
  const std::string path = folder.file("points.csv");
  std::ofstream(path) << "# from elsewhere\nmodel,psnr_db,bytes,vertices,faces,note,label\n"
                         "horse,63.5,2212,10,20,\"without, say, texture\",L1\nowl,70,3000,,,,\n";
  const std::vector<ForeignPoint> points = read_points_file(path);
  REQUIRE(points.size() == 2);
  CHECK(points[0].bytes == 2212);
  CHECK(points[0].psnr_db == 63.5);
  CHECK(points[0].note == "without, say, texture");
  CHECK(points[0].is_of("renamed", 10, 20));
  CHECK_FALSE(points[0].is_of("horse", 10, 21));
  CHECK(points[1].is_of("owl", 10, 20));
  CHECK_FALSE(points[1].is_of("horse", 10, 20));
  for (const char* bad : {"model,bytes\nhorse,1\n", "model,bytes,psnr_db\nhorse,0,1\n",
                          "model,bytes,psnr_db\nhorse,x,1\n", "model,bytes,psnr_db\nhorse,1,nan\n"}) {
    std::ofstream(path) << bad;
    CHECK(cause_of([&] { read_points_file(path); }) == Cause::Malformed);
  }
}

TEST_CASE("the points that are shipped can be read") {
  const std::filesystem::path folder(GSP_RECIPES);
  CHECK(read_points_file((folder / "points/vdmc.csv").string()).size() == 30);
  CHECK(read_points_file((folder / "points/neural.csv").string()).size() == 2);
  const std::vector<ForeignPoint> normal = read_points_file((folder / "points/normal-meshes.csv").string());
  CHECK(normal.size() == 8);
  for (const ForeignPoint& point : normal) CHECK((point.measured_on == "dinosaur" || point.measured_on == "molecule"));
}

TEST_CASE("Draco's own tool makes of a decimated surface the anchor's bytes") {
  if (!installed("draco_encoder")) return;
  Progress silent;
  ExternalTool tool =
      codec("draco_encoder -i {input} -o {output} -qp {value} -cl 10", "draco_decoder -i {input} -o {output}");
  tool.values = {"7", "10", "13"};
  const std::vector<Mesh> surfaces = decimate(shapes::bumpy_sphere(4), {1500, 300}, Decimation::Volume, silent);
  for (const Mesh& surface : surfaces) {
    const std::vector<CodedSurface> points = coded(tool, surface);
    REQUIRE(points.size() == 3);
    for (const CodedSurface& point : points) {
      const AnchorPoint anchor = draco_round_trip(surface, std::stoi(point.value));
      CHECK(point.bytes == anchor.bytes);
      CHECK(point.decoded.positions == anchor.decoded.positions);
      CHECK(point.decoded.faces == anchor.decoded.faces);
    }
  }
}
