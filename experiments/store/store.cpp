#include "experiments/store/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/curve/point_fields.h"
#include "experiments/store/database.h"
#include "mesh/atomic_file.h"

namespace gsp {

namespace {

using SortedJson = nlohmann::json;

constexpr int kSchemaVersion = 1;

// Keys are hashes, so tables without rowid hold the same bytes whatever the order in which rows came.
constexpr const char* kSchema = R"(
CREATE TABLE recipe(name TEXT PRIMARY KEY, turn INTEGER NOT NULL) WITHOUT ROWID;
CREATE TABLE model(recipe TEXT, position INTEGER, name TEXT NOT NULL, source TEXT NOT NULL, surface TEXT NOT NULL,
  path TEXT NOT NULL, vertices INTEGER NOT NULL, faces INTEGER NOT NULL, cause TEXT NOT NULL, failure TEXT NOT NULL,
  PRIMARY KEY(recipe, position)) WITHOUT ROWID;
CREATE TABLE cell(recipe TEXT, position INTEGER, model TEXT NOT NULL, label TEXT NOT NULL, options TEXT NOT NULL,
  parameterize TEXT NOT NULL, remesh TEXT NOT NULL, encode TEXT NOT NULL, measure TEXT NOT NULL,
  PRIMARY KEY(recipe, position)) WITHOUT ROWID;
CREATE TABLE stage(key TEXT PRIMARY KEY, kind TEXT NOT NULL, input TEXT NOT NULL, options TEXT NOT NULL,
  version TEXT NOT NULL, cause TEXT NOT NULL, failure TEXT NOT NULL, numbers TEXT NOT NULL,
  seconds REAL NOT NULL, cpu_seconds REAL NOT NULL, reference_seconds REAL NOT NULL) WITHOUT ROWID;
CREATE TABLE artefact(stage TEXT, role TEXT, path TEXT NOT NULL, PRIMARY KEY(stage, role)) WITHOUT ROWID;
)";

// Stores of this schema from before it hold no table of steps.
constexpr const char* kStepSchema = R"(
CREATE TABLE IF NOT EXISTS step(stage TEXT, position INTEGER, name TEXT NOT NULL, depth INTEGER NOT NULL,
  runs INTEGER NOT NULL, seconds REAL NOT NULL, cpu_seconds REAL NOT NULL, peak_megabytes REAL NOT NULL,
  PRIMARY KEY(stage, position)) WITHOUT ROWID;
)";

std::string key_of(const PlannedCell& cell, StageKind kind) {
  const auto key = cell.keys.find(kind);
  return key == cell.keys.end() ? std::string() : key->second;
}

// SQLite's integers are signed; the bits of an unsigned one stay.
std::int64_t stored(std::uint64_t value) { return static_cast<std::int64_t>(value); }
std::int64_t stored(int value) { return value; }
double stored(double value) { return value; }
const std::string& stored(const std::string& value) { return value; }

void load(const Statement& row, int column, std::uint64_t& value) {
  value = static_cast<std::uint64_t>(row.integer(column));
}
void load(const Statement& row, int column, int& value) { value = static_cast<int>(row.integer(column)); }
void load(const Statement& row, int column, double& value) { value = row.real(column); }
void load(const Statement& row, int column, std::string& value) { value = row.text(column); }

const char* sql_type(const PointMember& member) {
  if (std::holds_alternative<std::string CurvePoint::*>(member)) return "TEXT";
  return std::holds_alternative<double CurvePoint::*>(member) ? "REAL" : "INTEGER";
}

// The table of points: which stage, which point of it, then a column for each of `measured_fields`.
std::string point_schema() {
  std::string columns = "stage TEXT, position INTEGER";
  for (const PointField& field : measured_fields())
    columns += fmt::format(", {} {} NOT NULL", field.name, sql_type(field.member));
  return "CREATE TABLE point(" + columns + ", PRIMARY KEY(stage, position)) WITHOUT ROWID";
}

std::string point_columns() {
  std::string columns = "stage, position";
  for (const PointField& field : measured_fields()) columns += fmt::format(", {}", field.name);
  return columns;
}

// From a row of `point_columns`.
CurvePoint read_point(const Statement& row) {
  CurvePoint point;
  int column = 2;
  for (const PointField& field : measured_fields())
    std::visit([&](auto member) { load(row, column++, point.*member); }, field.member);
  return point;
}

}  // namespace

struct Store::Impl {
  std::string path;
  bool create;
  std::unique_ptr<Database> database;

  Impl(std::string file, bool make) : path(std::move(file)), create(make) { open(); }

  void open() {
    database = std::make_unique<Database>(path, create ? Access::Write : Access::Read);
    const auto version = database->prepare("PRAGMA user_version");
    version->step();
    const auto found = version->integer(0);
    version->restart();
    if (found == 0 && create) {
      database->execute("PRAGMA journal_mode=WAL");
      Transaction transaction(*database);
      database->execute(kSchema);
      database->execute(point_schema());
      database->execute("PRAGMA user_version=" + std::to_string(kSchemaVersion));
      transaction.commit();
    } else if (found != kSchemaVersion) {
      throw Error(Cause::Malformed, path + " has schema " + std::to_string(found) + ", this gsp reads schema " +
                                        std::to_string(kSchemaVersion) + "; sweep into a new folder");
    }
    if (create) database->execute(kStepSchema);
    // After a crash of the program everything committed is there; after one of the machine the last results may be
    // gone, and are computed again.
    if (create) database->execute("PRAGMA synchronous=NORMAL");
  }

  std::vector<std::string> recipes() const;
  Plan plan(const std::string& recipe) const;
  std::map<std::string, StageResult> results() const;

  // What `read` finds while nobody writes: where a sweep wrote in between, it is read again.
  template <class Read>
  auto consistent(const Read& read) {
    for (;; open()) try {
        auto found = read();
        if (!database->stale()) return found;
      } catch (const Error&) {
        if (!database->stale()) throw;
      }
  }

  std::string recipe_or_latest(const std::string& name) const {
    const auto row = database->prepare(name.empty() ? "SELECT name FROM recipe ORDER BY turn DESC LIMIT 1"
                                                    : "SELECT name FROM recipe WHERE name = ?");
    if (!name.empty()) row->bind(name);
    if (!row->step())
      throw Error(Cause::BadOption, name.empty() ? "the store holds no recipe" : "the store holds no recipe " + name);
    return row->text(0);
  }

  void make_latest(const std::string& recipe) {
    const auto latest = database->prepare("SELECT name, turn FROM recipe ORDER BY turn DESC LIMIT 1");
    std::int64_t turn = 1;
    if (latest->step()) {
      if (latest->text(0) == recipe) return;
      turn = latest->integer(1) + 1;
    }
    database->prepare("INSERT OR REPLACE INTO recipe VALUES(?,?)")->run(recipe, turn);
  }

  void put_one(const StageResult& r) {
    database->prepare("INSERT OR REPLACE INTO stage VALUES(?,?,?,?,?,?,?,?,?,?,?)")
        ->run(r.key, std::string(stage_name(r.kind)), r.input, r.options, r.version, r.cause, r.failure,
              SortedJson(r.numbers).dump(), r.seconds, r.cpu_seconds, r.reference_seconds);
    forget_details(r.key);
    const auto artefact = database->prepare("INSERT INTO artefact VALUES(?,?,?)");
    for (const auto& [role, path] : r.artefacts) artefact->run(r.key, role, path);
    put_steps(r);
    std::string places = "?,?";
    for (std::size_t i = 0; i < measured_fields().size(); ++i) places += ",?";
    const auto point = database->prepare(fmt::format("INSERT INTO point({}) VALUES({})", point_columns(), places));
    std::int64_t position = 0;
    for (const CurvePoint& p : r.points) {
      point->bind(r.key).bind(position++);
      for (const PointField& field : measured_fields())
        std::visit([&](auto member) { point->bind(stored(p.*member)); }, field.member);
      point->step();
      point->restart();
    }
  }

  void put_steps(const StageResult& r) {
    const auto step = database->prepare("INSERT INTO step VALUES(?,?,?,?,?,?,?,?)");
    std::int64_t position = 0;
    for (const ProfileStep& s : r.steps)
      step->run(r.key, position++, s.name, std::int64_t{s.depth}, std::int64_t{s.runs}, s.seconds, s.cpu_seconds,
                s.peak_megabytes);
  }

  bool has_steps() const { return database->prepare("SELECT 1 FROM sqlite_master WHERE name = 'step'")->step(); }

  void forget_details(const std::string& key) {
    database->prepare("DELETE FROM step WHERE stage = ?")->run(key);
    database->prepare("DELETE FROM artefact WHERE stage = ?")->run(key);
    database->prepare("DELETE FROM point WHERE stage = ?")->run(key);
  }
};

Store::Store(std::string folder, bool create) : folder_(std::move(folder)) {
  const std::string path = folder_ + "/results.sqlite";
  if (create) {
    make_folder(folder_ + "/artefacts");
  } else if (std::error_code failed; !std::filesystem::is_regular_file(path, failed)) {
    throw Error(Cause::CannotOpen, folder_ + " holds no results.sqlite: gsp sweep makes such a folder");
  }
  impl_ = std::make_unique<Impl>(path, create);
}

Store Store::open(const std::string& folder) { return Store(folder, false); }
Store Store::create(const std::string& folder) { return Store(folder, true); }
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

std::vector<std::string> Store::recipes() const {
  return impl_->consistent([&] { return impl_->recipes(); });
}

Plan Store::plan(const std::string& recipe) const {
  return impl_->consistent([&] { return impl_->plan(recipe); });
}

std::map<std::string, StageResult> Store::results() const {
  return impl_->consistent([&] { return impl_->results(); });
}

std::vector<std::string> Store::Impl::recipes() const {
  std::vector<std::string> names;
  const auto row = database->prepare("SELECT name FROM recipe ORDER BY turn DESC");
  while (row->step()) names.push_back(row->text(0));
  return names;
}

Plan Store::Impl::plan(const std::string& recipe) const {
  Plan plan;
  plan.recipe = recipe_or_latest(recipe);
  const auto model = database->prepare(
      "SELECT name, source, surface, path, vertices, faces, cause, failure FROM model WHERE recipe = ? ORDER BY "
      "position");
  model->bind(plan.recipe);
  while (model->step())
    plan.models.push_back({model->text(0), model->text(1), model->text(2), model->text(3),
                           static_cast<int>(model->integer(4)), static_cast<int>(model->integer(5)), model->text(6),
                           model->text(7)});
  const auto row = database->prepare(
      "SELECT model, label, options, parameterize, remesh, encode, measure FROM cell WHERE recipe = ? ORDER BY "
      "position");
  row->bind(plan.recipe);
  while (row->step()) {
    PlannedCell& cell = plan.cells.emplace_back();
    cell.model = row->text(0);
    cell.label = row->text(1);
    cell.options = options_from_json(row->text(2));
    int column = 3;
    for (StageKind kind : kStageKinds)
      if (std::string key = row->text(column++); !key.empty()) cell.keys[kind] = std::move(key);
  }
  return plan;
}

std::vector<StoredModel> Store::models(const std::string& recipe) const {
  std::vector<StoredModel> models = plan(recipe).models;
  for (StoredModel& model : models) model.path = in_store(folder_, model.path);
  return models;
}

std::vector<StoredCell> Store::cells(const std::string& recipe) const {
  return stored_cells(plan(recipe), results(), folder_);
}

std::map<std::string, StageResult> Store::Impl::results() const {
  std::map<std::string, StageResult> results;
  const auto stage = database->prepare(
      "SELECT key, kind, input, options, version, cause, failure, numbers, seconds, cpu_seconds, reference_seconds "
      "FROM "
      "stage");
  while (stage->step()) {
    StageResult& r = results[stage->text(0)];
    r.key = stage->text(0);
    r.kind = stage_of(stage->text(1));
    r.input = stage->text(2);
    r.options = stage->text(3);
    r.version = stage->text(4);
    r.cause = stage->text(5);
    r.failure = stage->text(6);
    const SortedJson numbers = SortedJson::parse(stage->text(7), nullptr, false);
    for (const auto& [name, value] : numbers.items())
      if (value.is_number()) r.numbers[name] = value.get<double>();
    r.seconds = stage->real(8);
    r.cpu_seconds = stage->real(9);
    r.reference_seconds = stage->real(10);
  }
  if (has_steps()) {
    const auto step = database->prepare(
        "SELECT stage, name, depth, runs, seconds, cpu_seconds, peak_megabytes FROM step ORDER BY stage, position");
    while (step->step())
      results[step->text(0)].steps.push_back({step->text(1), static_cast<int>(step->integer(2)),
                                              static_cast<int>(step->integer(3)), step->real(4), step->real(5),
                                              step->real(6)});
  }
  const auto artefact = database->prepare("SELECT stage, role, path FROM artefact");
  while (artefact->step()) results[artefact->text(0)].artefacts[artefact->text(1)] = artefact->text(2);
  const auto point = database->prepare(fmt::format("SELECT {} FROM point ORDER BY stage, position", point_columns()));
  while (point->step()) results[point->text(0)].points.push_back(read_point(*point));
  return results;
}

void Store::replace_plan(const Plan& plan) {
  Transaction transaction(*impl_->database);
  impl_->make_latest(plan.recipe);
  impl_->database->prepare("DELETE FROM model WHERE recipe = ?")->run(plan.recipe);
  impl_->database->prepare("DELETE FROM cell WHERE recipe = ?")->run(plan.recipe);
  const auto model = impl_->database->prepare("INSERT INTO model VALUES(?,?,?,?,?,?,?,?,?,?)");
  std::int64_t position = 0;
  for (const StoredModel& m : plan.models)
    model->run(plan.recipe, position++, m.name, m.source, m.surface_key, m.path, std::int64_t{m.vertices},
               std::int64_t{m.faces}, m.cause, m.failure);
  const auto cell = impl_->database->prepare("INSERT INTO cell VALUES(?,?,?,?,?,?,?,?,?)");
  position = 0;
  for (const PlannedCell& c : plan.cells)
    cell->run(plan.recipe, position++, c.model, c.label, options_json(c.options), key_of(c, StageKind::Parameterize),
              key_of(c, StageKind::Remesh), key_of(c, StageKind::Encode), key_of(c, StageKind::Measure));
  transaction.commit();
}

void Store::put(const std::vector<StageResult>& results) {
  Transaction transaction(*impl_->database);
  for (const StageResult& result : results) impl_->put_one(result);
  transaction.commit();
}

void Store::erase(const std::vector<std::string>& keys) {
  Transaction transaction(*impl_->database);
  const auto stage = impl_->database->prepare("DELETE FROM stage WHERE key = ?");
  for (const std::string& key : keys) {
    stage->run(key);
    impl_->forget_details(key);
  }
  transaction.commit();
}

}  // namespace gsp
