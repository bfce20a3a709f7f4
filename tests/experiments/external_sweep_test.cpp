#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "cause_of.h"
#include "experiments/curve/curve_csv.h"
#include "experiments/sweep/sweep.h"
#include "mesh/io.h"
#include "mesh/shapes.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

// A sweep of external methods on an icosahedron quadrisected three times.
class ExternalStudy {
 public:
  ExternalStudy() { write_mesh(file("ball.ply"), shapes::sphere(3)); }

  std::string file(const std::string& name) const { return folder_.file(name); }
  std::string store() const { return file("store"); }

  void script(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }

  std::string recipe(const std::string& text) const {
    std::ofstream(file("r.toml")) << "models = [\"" << file("ball.ply") << "\"]\nsamples = 2000\nbudgets = [200]\n"
                                  << text;
    return file("r.toml");
  }

  SweepResult run(const std::string& text) const {
    SweepOptions options;
    options.jobs = 1;
    options.program = GSP_PROGRAM;
    Progress silent;
    return sweep(read_recipe(recipe(text)), store(), options, silent);
  }

 private:
  TemporaryFolder folder_;
};

const StoredCell& cell_of(const SweepResult& result, const std::string& label) {
  for (const StoredCell& cell : result.cells)
    if (cell.label == label) return cell;
  throw Error(Cause::Internal, "no cell " + label);
}

std::string refusal_of(const ExternalStudy& study, const std::string& text) {
  try {
    read_recipe(study.recipe(text));
  } catch (const Error& error) {
    CHECK(error.cause() == Cause::BadOption);
    return error.what();
  }
  return "";
}

bool contains_text(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr const char* kCopy =
    "encode = \"sh {folder}/copy.sh {input} {output} {value}\"\ndecode = \"cp {input} {output}\"\n";

}  // namespace

TEST_CASE(
    "external methods are cells beside ours; those that hang, crash, write nothing or garbage are rows with causes") {
  const ExternalStudy study;
  study.script("copy.sh", "cp \"$1\" \"$2\"\n");
  const SweepResult result = study.run(std::string(R"(
method = "draco"
[[external]]
name = "copy"
)") + kCopy + R"(values = [1, 2]
[[external]]
name = "hangs"
encode = "sleep 100"
decode = "true"
time_limit = 0.3
[[external]]
name = "crashes"
encode = "sh -c 'echo oh no >&2; kill -SEGV $$'"
decode = "true"
[[external]]
name = "silent"
encode = "true"
decode = "true"
[[external]]
name = "garbage"
encode = "cp {input} {output}"
decode = "sh -c 'echo garbage > \"$1\"' x {output}"
[[external]]
name = "missing"
encode = "no-such-program-anywhere"
decode = "true"
[[external]]
name = "remesher"
remesh = "cp {input} {output}"
[[external]]
name = "no-remesher"
remesh = "sh -c 'head -c 100 \"$1\" > \"$2\"' x {input} {output}"
)");
  REQUIRE(result.cells.size() == 9);
  CHECK(cell_of(result, "draco").status == CellStatus::Done);
  const StoredCell& copy = cell_of(result, "copy");
  CHECK(copy.status == CellStatus::Done);
  const std::vector<CurvePoint> points = copy.points();
  REQUIRE(points.size() == 2);
  CHECK(points[0].method == "copy");
  CHECK(points[0].coder == "copy 1");
  CHECK(points[0].bytes > 1000);
  CHECK(points[0].psnr_db > 120.0);  // single precision
  const std::pair<const char*, const char*> failures[] = {{"hangs", "timed-out"},      {"crashes", "tool-failed"},
                                                          {"silent", "tool-failed"},   {"garbage", "malformed"},
                                                          {"missing", "tool-missing"}, {"no-remesher", "truncated"}};
  for (const auto& [label, cause] : failures) {
    CAPTURE(label);
    const StoredCell& cell = cell_of(result, label);
    CHECK(cell.status == CellStatus::Failed);
    CHECK(cell.cause == cause);
  }
  CHECK(contains_text(cell_of(result, "crashes").failure, "oh no"));
  const StoredCell& remesh = cell_of(result, "remesher");
  CHECK(remesh.status == CellStatus::Done);
  CHECK(remesh.number("level") == 3.0);
  REQUIRE(remesh.points().size() == 2);
  CHECK(remesh.points()[0].bytes == 200);
  CHECK(remesh.points()[0].base_faces == 20);
  CHECK(remesh.points()[0].gamma == 0.0);
  CHECK_FALSE(std::filesystem::exists(study.store() + "/artefacts/external"));
  // The curve is the table's, read back.
  std::size_t rows = 0;
  for (const CurvePoint& point : read_curve_csv(study.store() + "/curve.csv")) rows += point.method == "copy";
  CHECK(rows == 2);
}

TEST_CASE("what an external method made is kept until its command, version, values or files change") {
  const ExternalStudy study;
  study.script("copy.sh", "echo ran >> \"$(dirname \"$0\")/log\"; cp \"$1\" \"$2\"\n");
  const auto runs = [&](const std::string& rest) {
    std::filesystem::remove(study.file("log"));
    const SweepResult result =
        study.run(std::string("[[block]]\nmethod = \"draco\"\n[[external]]\nname = \"copy\"\n") + kCopy + rest);
    CHECK(cell_of(result, "copy").status == CellStatus::Done);
    std::ifstream log(study.file("log"));
    return std::count(std::istreambuf_iterator<char>(log), {}, '\n');
  };
  CHECK(runs("values = [1]\n") == 1);
  CHECK(runs("values = [1]\n") == 0);
  CHECK(runs("values = [1]\ntime_limit = 7\nmemory_limit = 4000\n") == 0);
  CHECK(runs("values = [1, 2]\n") == 2);
  CHECK(runs("values = [1]\nversion = \"echo 2\"\n") == 1);
  CHECK(runs("values = [1]\nversion = \"echo 3\"\n") == 1);
  study.script("copy.sh", "echo ran again >> \"$(dirname \"$0\")/log\"; cp \"$1\" \"$2\"\n");
  CHECK(runs("values = [1]\n") == 1);
}

TEST_CASE("what cannot be an external method is refused with its line before anything runs") {
  const ExternalStudy study;
  CHECK(contains_text(refusal_of(study, "[[external]]\nname = \"a\"\nencoder = \"x\"\n"), "did you mean encode?"));
  CHECK(contains_text(refusal_of(study, "[[external]]\nname = \"a\"\nencode = \"x\"\n"), "line 4"));
  CHECK(contains_text(refusal_of(study, "[[external]]\nname = \"draco\"\npoints = \"x\"\n"),
                      "there is a method draco already"));
  CHECK(contains_text(refusal_of(study, "[[external]]\nname = \"a\"\nmethod = \"gsp\"\npoints = \"x\"\n"),
                      "has no method"));
  CHECK(contains_text(refusal_of(study, "external = 3\n"), "write [[external]]"));
}

TEST_CASE("points are a curve of the surface that they are about") {
  const ExternalStudy study;
  const Mesh ball = shapes::sphere(3);
  std::ofstream(study.file("p.csv")) << "model,vertices,faces,bytes,psnr_db,label,note\nball of others,"
                                     << ball.vertex_count() << ',' << ball.face_count() << ",1000,50,L1,no texture\n"
                                     << "ball,3,1,2000,60,L2,\n";
  const std::string text = "method = \"draco\"\n[[external]]\nname = \"others\"\npoints = \"{folder}/p.csv\"\n";
  const std::vector<CurvePoint> points = cell_of(study.run(text), "others").points();
  REQUIRE(points.size() == 1);
  CHECK(points[0].model == "ball");
  CHECK(points[0].bytes == 1000);
  CHECK(points[0].psnr_db == 50.0);
  CHECK(points[0].coder == "L1: no texture");
  // The file changed, and so does the curve.
  std::ofstream(study.file("p.csv")) << "model,bytes,psnr_db\nnone,1000,50\n";
  const StoredCell none = cell_of(study.run(text), "others");
  CHECK(none.status == CellStatus::Failed);
  CHECK(contains_text(none.failure, "has no points of ball"));
}

TEST_CASE("a sweep that is interrupted leaves no external process") {
  const ExternalStudy study;
  study.script("hang.sh", "sleep 100 & echo $! > \"$1.part\"; mv \"$1.part\" \"$1\"; wait\n");
  const std::string file =
      study.recipe("[[block]]\nmethod = \"draco\"\n[[external]]\nname = \"hangs\"\nencode = \"sh {folder}/hang.sh " +
                   study.file("pid") + "\"\ndecode = \"true\"\n");
  const pid_t sweep = ::fork();
  if (sweep == 0) {
    ::execl(GSP_PROGRAM, "gsp", "sweep", file.c_str(), "--store", study.store().c_str(), "--quiet", nullptr);
    ::_exit(127);
  }
  for (int i = 0; i < 6000 && !std::filesystem::exists(study.file("pid")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  pid_t sleeper = 0;
  std::ifstream(study.file("pid")) >> sleeper;
  REQUIRE(sleeper > 0);
  CHECK(::kill(sleeper, 0) == 0);
  int number = 0;
  SECTION("by a signal that nothing can catch") { number = SIGKILL; }
  SECTION("by Ctrl-C") { number = SIGINT; }
  REQUIRE(::kill(sweep, number) == 0);
  int status = 0;
  REQUIRE(::waitpid(sweep, &status, 0) == sweep);
  if (number == SIGINT) CHECK(WEXITSTATUS(status) == 130);
  for (int i = 0; i < 500 && ::kill(sleeper, 0) == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(::kill(sleeper, 0) != 0);
}
