#include "experiments/store/store.h"

#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "experiments/store/database.h"
#include "experiments/store/folder_lock.h"
#include "experiments/sweep/sweep.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

StageResult result_of(StageKind kind, const std::string& key) {
  StageResult result;
  result.kind = kind;
  result.key = key;
  result.seconds = 1.5;
  return result;
}

// Two cells of one model that share a map; nothing has run.
Plan sample_plan(const std::string& recipe) {
  Plan plan;
  plan.recipe = recipe;
  plan.models.push_back({.name = "torus",
                         .source = "shape:torus",
                         .surface_key = "s",
                         .path = "artefacts/s.ply",
                         .vertices = 100,
                         .faces = 200,
                         .cause = {},
                         .failure = {}});
  for (Wavelet wavelet : {Wavelet::Loop, Wavelet::Butterfly}) {
    PlannedCell cell{.model = "torus", .label = wavelet_name(wavelet), .options = {}, .keys = {}};
    cell.options.encode.wavelet = wavelet;
    cell.options.budgets = {512, 1024};
    cell.keys = {{StageKind::Parameterize, "map"},
                 {StageKind::Remesh, "remesh"},
                 {StageKind::Encode, "encode-" + cell.label},
                 {StageKind::Measure, "measure-" + cell.label}};
    plan.cells.push_back(cell);
  }
  return plan;
}

std::vector<StageResult> shared_stages() {
  StageResult map = result_of(StageKind::Parameterize, "map");
  map.numbers = {{"base_vertices", 20}, {"base_faces", 36}};
  map.artefacts = {{"map", "artefacts/m.param.ply"}};
  map.steps = {{"simplify", 0, 1, 2.5, 3.5, 40.0}, {"price all vertices", 1, 2, 1.25, 1.5, 30.0}};
  StageResult remesh = result_of(StageKind::Remesh, "remesh");
  remesh.numbers = {{"level", 3}, {"remesh_error", 1e-4}};
  return {map, remesh};
}

StageResult measured(const std::string& key) {
  StageResult result = result_of(StageKind::Measure, key);
  for (std::size_t bytes : {512u, 2048u}) {
    CurvePoint point;
    point.bytes = bytes;
    point.psnr_db = bytes == 512 ? 50.25 : std::numeric_limits<double>::infinity();
    point.seed = 7;
    result.points.push_back(point);
  }
  return result;
}

}  // namespace

TEST_CASE("a store gives back its cells: waiting, done with rows, failed with the cause") {
  const TemporaryFolder folder;
  Store store = Store::create(folder.path().string());
  store.replace_plan(sample_plan("one"));
  for (const StoredCell& cell : store.cells()) CHECK(cell.status == CellStatus::Waiting);

  std::vector<StageResult> results = shared_stages();
  results.push_back(result_of(StageKind::Encode, "encode-loop"));
  results.push_back(measured("measure-loop"));
  results.push_back(result_of(StageKind::Encode, "encode-butterfly"));
  results.back().cause = "solver-failed";
  results.back().failure = "the system is singular";
  store.put(results);

  const Store reader = Store::open(folder.path().string());
  CHECK(reader.models().front().path == folder.file("artefacts/s.ply"));
  const std::vector<StoredCell> cells = reader.cells("one");
  REQUIRE(cells.size() == 2);
  CHECK(cells[0].status == CellStatus::Done);
  CHECK(cells[0].artefact("map") == folder.file("artefacts/m.param.ply"));
  CHECK(cells[0].artefact("stream").empty());
  CHECK(*cells[0].number("base_faces") == 36);
  const std::vector<ProfileStep>& steps = cells[0].stage(StageKind::Parameterize)->steps;
  REQUIRE(steps.size() == 2);
  CHECK(steps[0].name == "simplify");
  CHECK(steps[1].name == "price all vertices");
  CHECK((steps[1].depth == 1 && steps[1].runs == 2 && steps[1].seconds == 1.25));
  CHECK((steps[1].cpu_seconds == 1.5 && steps[1].peak_megabytes == 30.0));
  CHECK_FALSE(cells[0].number("no such number"));
  CHECK(cells[0].options.budgets == std::vector<std::size_t>{512, 1024});
  const std::vector<CurvePoint> rows = cells[0].points();
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].model == "torus");
  CHECK(rows[0].wavelet == "loop");
  CHECK(rows[0].level == 3);
  CHECK(rows[0].remesh_error == 1e-4);
  CHECK(rows[0].seed == 7);
  CHECK(std::isinf(rows[1].psnr_db));

  CHECK(cells[1].status == CellStatus::Failed);
  CHECK(cells[1].cause == "solver-failed");
  CHECK(cells[1].points().empty());
}

TEST_CASE("a store from before steps were kept is read as it is, and takes them when it is written again") {
  const TemporaryFolder folder;
  {
    Store store = Store::create(folder.path().string());
    store.replace_plan(sample_plan("one"));
    store.put(shared_stages());
    Database(folder.file("results.sqlite"), Access::Write).execute("DROP TABLE step");
  }
  const auto steps = [](const Store& store) {
    return store.cells("one").front().stage(StageKind::Parameterize)->steps.size();
  };
  CHECK(steps(Store::open(folder.path().string())) == 0);
  Store store = Store::create(folder.path().string());
  store.put(shared_stages());
  CHECK(steps(store) == 2);
}

TEST_CASE("recipes share results, and the latest swept one is the default") {
  const TemporaryFolder folder;
  Store store = Store::create(folder.path().string());
  store.replace_plan(sample_plan("one"));
  store.put(shared_stages());
  store.replace_plan(sample_plan("two"));
  CHECK(store.recipes() == std::vector<std::string>{"two", "one"});
  CHECK(store.cells("two").front().stages.size() == 2);
  store.replace_plan(sample_plan("one"));
  CHECK(store.recipes().front() == "one");
  CHECK_THROWS_AS(store.cells("three"), Error);
  store.erase({"map"});
  CHECK(store.cells("one").front().stages.size() == 1);
}

TEST_CASE("a folder without a store, a damaged one and one of another schema are refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(Store::open(folder.path().string()), Error);
  std::ofstream(folder.file("results.sqlite")) << std::string(5000, 'x');
  CHECK_THROWS_AS(Store::open(folder.path().string()), Error);
  CHECK_THROWS_AS(Store::create(folder.path().string()), Error);
}

namespace {

/// Makes a folder and all in it unwritable for as long as it lives. Root may write all the same, so it is another user
/// meanwhile.
class Unwritable {
 public:
  explicit Unwritable(const TemporaryFolder& folder) : folder_(folder.path()) {
    permit(std::filesystem::perm_options::remove);
    if (::geteuid() == 0) other_ = ::seteuid(65534) == 0;
  }
  ~Unwritable() {
    if (other_ && ::seteuid(0) != 0) std::abort();
    permit(std::filesystem::perm_options::add);
  }

 private:
  void permit(std::filesystem::perm_options how) const {
    using std::filesystem::perms;
    const auto write = perms::owner_write | perms::group_write | perms::others_write;
    std::filesystem::permissions(folder_, how == std::filesystem::perm_options::add ? perms::owner_write : write, how);
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      std::filesystem::permissions(
          entry.path(), entry.is_directory() || how == std::filesystem::perm_options::add ? perms::owner_write : write,
          how);
  }
  std::filesystem::path folder_;
  bool other_ = false;
};

std::vector<std::string> names_in(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_CASE("a store that cannot be written can be read") {
  const TemporaryFolder folder;
  {
    Store store = Store::create(folder.path().string());
    store.replace_plan(sample_plan("one"));
    store.put(shared_stages());
  }
  const Unwritable unwritable(folder);
  const Store store = Store::open(folder.path().string());
  CHECK(store.recipes() == std::vector<std::string>{"one"});
  CHECK(store.cells().front().stages.size() == 2);
}

TEST_CASE("what a killed sweep left in the log is read too, where nothing can be written") {
  const TemporaryFolder live, dead;
  Store store = Store::create(live.path().string());
  store.replace_plan(sample_plan("one"));
  store.put(shared_stages());
  // As a kill leaves it: the log is not taken into the file.
  for (const char* part : {"", "-wal"})
    std::filesystem::copy_file(live.file("results.sqlite") + part, dead.file("results.sqlite") + part);
  REQUIRE(std::filesystem::file_size(dead.file("results.sqlite-wal")) > 0);
  const Unwritable unwritable(dead);
  CHECK(Store::open(dead.path().string()).cells().front().stages.size() == 2);
}

TEST_CASE("reading a store leaves no file in it, and follows a sweep that writes") {
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  {
    Store store = Store::create(path);
    store.replace_plan(sample_plan("one"));
  }
  const std::vector<std::string> before = names_in(folder);
  const Store reader = Store::open(path);
  CHECK(reader.cells().front().stages.empty());
  CHECK(names_in(folder) == before);
  {
    Store writer = Store::create(path);
    writer.put(shared_stages());
  }
  CHECK(reader.cells().front().stages.size() == 2);
  CHECK(names_in(folder) == before);
}

TEST_CASE("the lock is asked for without taking it, and comes before the database") {
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  CHECK_FALSE(FolderLock::held(path));
  const auto lock = std::make_unique<FolderLock>(path);
  CHECK(FolderLock::held(path));
  CHECK_THROWS_AS(FolderLock(path), Error);
  Progress silent;
  Recipe recipe;
  recipe.name = "none";
  CHECK_THROWS_AS(sweep(recipe, path, {}, silent), Error);
  CHECK_FALSE(std::filesystem::exists(folder.file("results.sqlite")));
}
