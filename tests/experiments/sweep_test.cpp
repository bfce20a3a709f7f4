#include "experiments/sweep/sweep.h"

#include <signal.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "experiments/check/check.h"
#include "experiments/curve/meter.h"
#include "experiments/sweep/worker.h"
#include "mesh/io.h"
#include "mesh/random.h"
#include "mesh/read_file.h"
#include "mesh/shapes.h"
#include "param/map/param_file.h"
#include "temporary_folder.h"

using namespace gsp;
namespace fs = std::filesystem;

namespace {

// Two small surfaces on which a whole sweep takes a moment, and recipes about them.
class Study {
 public:
  Study() {
    Mesh bumpy = shapes::bumpy_sphere(2);
    write_mesh(folder_.file("bumpy.ply"), bumpy);
    write_mesh(folder_.file("torus.ply"), shapes::torus(12, 8));
  }

  std::string file(const std::string& name) const { return folder_.file(name); }
  std::string store() const { return folder_.file("store"); }

  std::string recipe_file(const std::string& rest, const std::string& models = "*.ply") const {
    std::ofstream(file("study.toml")) << "models = [\"" << file(models) << "\"]\nbudgets = [128, 256, 512]\n"
                                      << "samples = 2000\nbase_vertices = 12\nlevel = 3\n"
                                      << rest;
    return file("study.toml");
  }

  SweepResult run(const std::string& rest, const std::string& models = "*.ply", int jobs = 1) const {
    return sweep(read_recipe(recipe_file(rest, models)), store(), options(jobs), silent_);
  }

  static SweepOptions options(int jobs) {
    SweepOptions options;
    options.jobs = jobs;
    options.program = GSP_PROGRAM;
    return options;
  }

 private:
  TemporaryFolder folder_;
  mutable Progress silent_;
};

int count(const std::vector<StoredCell>& cells, CellStatus status) {
  return static_cast<int>(
      std::count_if(cells.begin(), cells.end(), [&](const StoredCell& cell) { return cell.status == status; }));
}

// Every row of every table but the times, as text.
std::string dump(const std::string& store) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open((store + "/results.sqlite").c_str(), &database) == SQLITE_OK);
  std::string text;
  const auto append = [](void* out, int columns, char** values, char**) {
    for (int i = 0; i < columns; ++i) *static_cast<std::string*>(out) += std::string(values[i] ? values[i] : "") + '|';
    *static_cast<std::string*>(out) += '\n';
    return 0;
  };
  for (const char* query : {"SELECT * FROM recipe", "SELECT * FROM model", "SELECT * FROM cell",
                            "SELECT key, kind, input, options, version, cause, failure, numbers FROM stage",
                            "SELECT * FROM artefact", "SELECT * FROM point"})
    REQUIRE(sqlite3_exec(database, query, append, &text, nullptr) == SQLITE_OK);
  sqlite3_close(database);
  return text;
}

constexpr const char* kTwoMethods = "method = [\"gsp\", \"maps-smoothed\", \"draco\"]\n";

}  // namespace

TEST_CASE("a sweep runs every stage once, then finds everything done") {
  const Study study;
  const SweepResult first = study.run(kTwoMethods, "*.ply", 2);
  CHECK(first.cells.size() == 6);
  CHECK(count(first.cells, CellStatus::Done) == 6);
  CHECK(first.stages_run == 2 * (4 + 4 + 1));
  CHECK(fs::exists(first.cells.front().artefact("map")));
  CHECK(fs::exists(first.cells.front().artefact("stream")));
  CHECK_FALSE(first.cells.front().stage(StageKind::Parameterize)->steps.empty());
  const std::string csv = read_file(study.store() + "/curve.csv");
  CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == points_of(first.cells).size() + 1);

  CHECK(study.run(kTwoMethods).stages_run == 0);
  CHECK(read_file(study.store() + "/curve.csv") == csv);
  // Another wavelet on the same maps: nothing but coding and measuring.
  const SweepResult wavelets = study.run("method = \"gsp\"\nwavelet = [\"loop\", \"butterfly\"]\n");
  CHECK(wavelets.stages_run == 2 * 2);
  CHECK(wavelets.cells.front().label == "gsp wavelet=loop");
  // The same surface under another name and in another format is the same.
  write_mesh(study.file("copy.off"), read_mesh(study.file("torus.ply")));
  CHECK(study.run(kTwoMethods, "copy.off").stages_run == 0);
}

TEST_CASE("a mode shares the map, the remesh and the embedded stream, and keeps a stream for each of its sizes") {
  const Study study;
  const SweepResult result = study.run("method = \"gsp\"\nmode = [\"embedded\", \"fixed\"]\n", "torus.ply");
  CHECK(result.stages_run == 4 + 1);
  REQUIRE(result.cells.size() == 2);
  const StoredCell &embedded = result.cells[0], &fixed = result.cells[1];
  CHECK(fixed.label == "gsp mode=fixed");
  CHECK(fixed.artefact("stream") == embedded.artefact("stream"));
  const std::vector<CurvePoint> rows = fixed.points();
  REQUIRE(rows.size() == embedded.points().size());
  for (const CurvePoint& row : rows) {
    CHECK(row.coder == "gsp-fixed");
    CHECK(fs::file_size(fixed.stream_file(row.bytes)) == row.bytes);
    CHECK(embedded.stream_file(row.bytes) == embedded.artefact("stream"));
  }
}

TEST_CASE("a surface or a stage that fails is a row with its cause, and the others go on") {
  const Study study;
  std::ofstream(study.file("broken.ply")) << "ply\nformat ascii 1.0\nelement vertex";
  std::ofstream(study.file("fan.ply"))
      << "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double "
         "y\nproperty double z\nelement face 3\nproperty list uchar int "
         "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 "
         "0 3\n3 0 1 4\n";
  const SweepResult result = study.run("method = [\"gsp\", \"maps\"]\n");
  CHECK(result.failed());
  REQUIRE(result.cells.size() == 8);
  CHECK(count(result.cells, CellStatus::Done) == 4);
  for (const StoredCell& cell : result.cells) {
    if (cell.model == "broken") CHECK(cell.cause == "truncated");
    if (cell.model == "fan") CHECK(cell.cause == "non-manifold-edge");
  }
  CHECK(study.run("method = [\"gsp\", \"maps\"]\n").stages_run == 0);
  const auto cells = planned_cells(read_recipe(study.file("study.toml")), study.store());
  CHECK(count(cells, CellStatus::Failed) == 4);
}

TEST_CASE("a stage that brings its worker down is a failure of its cell alone, and is tried again next time") {
  const Study study;
  // Crashes at the first map of the torus, once; otherwise it is gsp.
  const std::string program = study.file("crashing-gsp");
  std::ofstream(program) << "#!/bin/sh\nif [ ! -e " << study.file("crashed") << " ]; then touch "
                         << study.file("crashed")
                         << "\n  key=$(grep -o '\"remesh\": \"[0-9a-f]*\"' \"$5\" | head -1 | cut -d'\"' -f4)\n"
                         << "  echo begin $key; kill -SEGV $$\nfi\nexec " << GSP_PROGRAM << " \"$@\"\n";
  ::chmod(program.c_str(), 0755);
  SweepOptions options = Study::options(1);
  options.program = program;
  Progress silent;
  const Recipe recipe = read_recipe(study.recipe_file(kTwoMethods, "torus.ply"));
  const SweepResult crashed = sweep(recipe, study.store(), options, silent);
  CHECK(count(crashed.cells, CellStatus::Failed) == 1);
  CHECK(count(crashed.cells, CellStatus::Done) == 2);
  for (const StoredCell& cell : crashed.cells)
    if (cell.status == CellStatus::Failed) CHECK(cell.cause == "crashed");
  const SweepResult again = sweep(recipe, study.store(), options, silent);
  CHECK(count(again.cells, CellStatus::Done) == 3);
}

TEST_CASE("files that were damaged or deleted are made again where something needs them") {
  const Study study;
  const SweepResult first = study.run("", "torus.ply");
  const std::string remesh = first.cells.front().artefact("remesh");
  std::ofstream(remesh, std::ios::app) << "x";
  fs::remove(first.cells.front().artefact("map"));
  const SweepResult second = study.run("wavelet = \"butterfly\"\n", "torus.ply");
  CHECK(count(second.cells, CellStatus::Done) == 1);
  CHECK(fs::exists(second.cells.front().artefact("map")));
}

TEST_CASE("a gamma changed to 0, or a wavelet broken on purpose, fails the check, which names the rows") {
  const Study study;
  const std::vector<StoredCell> cells = study.run("method = [\"gsp\", \"draco\"]\n", "bumpy.ply").cells;
  const Baseline baseline = baseline_of("study", cells);
  CHECK(check(baseline, baseline_of("study", cells), {}).passed());
  const auto failing_labels = [&](const std::vector<StoredCell>& now) {
    const CheckResult result = check(baseline, baseline_of("study", now), {.times = false});
    CHECK_FALSE(result.passed());
    std::set<std::string> labels;
    for (const Movement& movement : result.moved)
      if (movement.fails()) labels.insert(movement.model + ' ' + movement.label);
    return labels;
  };
  const std::set<std::string> only_gsp = {"bumpy gsp"};
  CHECK(failing_labels(study.run("method = [\"gsp\", \"draco\"]\ngamma = 0\n", "bumpy.ply").cells) == only_gsp);

  // A synthesis filter that loses what it should add on the finest level, in the decoder alone.
  std::vector<StoredCell> broken = cells;
  const std::string stream = read_file(cells.front().artefact("stream"));
  const Mesh surface = read_mesh(study.file("bumpy.ply"));
  const Meter meter(surface, "bumpy", 1);
  Progress silent;
  for (CurvePoint& point : broken.front().stages.back().points) {
    SemiregularMesh decoded = decode({stream.begin(), stream.end()}, point.bytes);
    const auto levels = subdivision_levels(decoded.base_vertices, decoded.base_faces, decoded.level);
    const SubdivisionLevel& coarse = levels[levels.size() - 2];
    for (std::size_t e = 0; e < coarse.edges.size(); ++e)
      decoded.positions[static_cast<std::size_t>(coarse.vertex_count) + e] =
          0.5 * (decoded.positions[static_cast<std::size_t>(coarse.edges[e][0])] +
                 decoded.positions[static_cast<std::size_t>(coarse.edges[e][1])]);
    point = meter.measure(decoded.mesh(), point.bytes, 2000, silent);
  }
  CHECK(failing_labels(broken) == only_gsp);
}

TEST_CASE("one sweep at a time works on a folder, and fail-fast stops at the first failure") {
  const Study study;
  std::ofstream(study.file("fan.ply")) << "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n";
  SweepOptions options = Study::options(1);
  options.fail_fast = true;
  Progress silent;
  const Recipe recipe = read_recipe(study.recipe_file(""));
  int calls = 0;
  Progress nosy([&](const std::string&, double) {
    if (calls++ == 0) {
      CHECK(sweep_at_work(study.store()));
      CHECK_THROWS_AS(sweep(recipe, study.store(), options, silent), Error);
    }
    return true;
  });
  const SweepResult result = sweep(recipe, study.store(), options, nosy);
  CHECK(calls > 0);
  CHECK_FALSE(sweep_at_work(study.store()));
  CHECK(result.failed());
}

namespace {

// Kills sweeps at that many random moments, each resumed until it is done, and then the next from nothing; all must end
// like an undisturbed one. Returns how many were done.
int kill_and_resume(int kills) {
  const Study whole;
  // The same surfaces by the same names, so that the rows can be equal.
  const std::string recipe = whole.recipe_file(kTwoMethods);
  const auto start = std::chrono::steady_clock::now();
  whole.run(kTwoMethods, "*.ply", 2);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  Random random(6);
  int done = 0;
  for (int killed = 0; killed < kills; ++done) {
    const TemporaryFolder folder;
    const std::string store = folder.file("store");
    for (bool finished = false; !finished;) {
      Worker victim(GSP_PROGRAM, {"sweep", recipe, "--store", store, "--jobs", "2", "-q"});
      if (killed < kills) {
        std::this_thread::sleep_for(std::chrono::duration<double>(0.7 * random.uniform() * seconds));
        victim.kill();
      }
      const WorkerEnd end = victim.wait();
      killed += end.signal != 0;
      finished = end.signal == 0;
      if (finished) REQUIRE(end.status == 0);
    }
    CHECK(dump(store) == dump(whole.store()));
    CHECK(read_file(store + "/curve.csv") == read_file(whole.store() + "/curve.csv"));
  }
  return done;
}

}  // namespace

TEST_CASE("a sweep killed at random moments and resumed ends with the same database and table") {
  CHECK(kill_and_resume(4) >= 1);
}

TEST_CASE("sweeps killed at fifty random moments end with the same database and table", "[slow]") {
  const int done = kill_and_resume(50);
  INFO(done << " sweeps done");
  CHECK(done >= 2);
}

TEST_CASE(
    "a baseline's map is the same bytes alone, beside the other methods, and in a sweep that finds gsp's map done") {
  const std::string all = "method = [\"gsp\", \"maps\", \"maps-smoothed\", \"hybrid\"]\n";
  const auto maps_of = [&](const std::vector<std::string>& runs) {
    const Study study;
    write_mesh(study.file("open.ply"), shapes::grid(16, 12, 0.1));
    std::map<std::string, std::string> maps;
    for (const std::string& run : runs)
      for (const StoredCell& cell : study.run(run, "open.ply").cells)
        maps[cell.options.method] = read_file(cell.artefact("map"));
    return maps;
  };
  const auto beside = maps_of({all});
  CHECK(beside.size() == 4);
  CHECK(maps_of({"method = \"gsp\"\n", all}) == beside);
  CHECK(maps_of({"method = \"hybrid\"\n", "method = \"maps-smoothed\"\n", "method = \"maps\"\n",
                 "method = \"gsp\"\n"}) == beside);
}

TEST_CASE("hybrid cells of one recipe that differ in weights have different maps") {
  const Study study;
  const SweepResult result = study.run("method = \"hybrid\"\nweights = [\"mean-value\", \"uniform\"]\n", "bumpy.ply");
  REQUIRE(result.cells.size() == 2);
  CHECK(read_file(result.cells[0].artefact("map")) != read_file(result.cells[1].artefact("map")));
}

TEST_CASE("what differs from model to model only is no part of a label, so that curves compare across models") {
  const Study study;
  const auto labels = [&](const std::string& models) {
    std::ofstream(study.file("labels.toml")) << "models = [" << models << "]\nmethod = [\"gsp\", \"maps\"]\n";
    std::set<std::string> found;
    for (const StoredCell& cell : planned_cells(read_recipe(study.file("labels.toml")), study.store()))
      found.insert(cell.label);
    return found;
  };
  const std::string torus = "{ path = \"" + study.file("torus.ply") + "\", base_vertices = 12 }";
  CHECK(labels("\"" + study.file("bumpy.ply") + "\", " + torus) == std::set<std::string>{"gsp", "maps"});
  const std::string both = "{ path = \"" + study.file("bumpy.ply") + "\", base_vertices = [12, 16], method = \"gsp\" }";
  CHECK(labels(both + ", " + torus) == std::set<std::string>{"gsp base_vertices=12", "gsp base_vertices=16", "maps"});
}

TEST_CASE("replicates share a label and are measured apart, the anchor once") {
  const Study study;
  const SweepResult result = study.run("method = [\"gsp\", \"maps\", \"draco\"]\nreplicates = 3\n", "bumpy.ply");
  CHECK_FALSE(result.failed());
  REQUIRE(result.cells.size() == 3 + 3 + 1);
  for (const StoredCell& cell : result.cells) {
    CHECK(cell.label == cell.options.method);
    for (const CurvePoint& point : cell.points()) CHECK(point.replicate == cell.options.parameterize.replicate);
  }
  const std::vector<CurveSummary> summaries = summaries_of(result.cells);
  REQUIRE(summaries.size() == 1);
  REQUIRE(summaries[0].methods.size() == 3);
  CHECK(summaries[0].methods[0].replicates == 3);
  CHECK(summaries[0].methods[1].replicates == 3);
  CHECK(summaries[0].methods[2].replicates == 1);
}
