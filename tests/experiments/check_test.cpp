#include "experiments/check/check.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>

#include "mesh/error.h"
#include "metrics/bootstrap.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

// Two cells as a run has them: a curve of 5 dB an octave from 256 bytes on, and a few numbers.
Baseline sample_run() {
  Baseline run = baseline_of("smoke", {});
  for (const char* label : {"gsp", "maps"}) {
    BaselineRow row{.model = "torus",
                    .label = label,
                    .options = {{"gamma", "2"}},
                    .cause = {},
                    .replicates = 1,
                    .numbers = {},
                    .deviations = {},
                    .times = {},
                    .curve = {},
                    .ceiling_db = 95.0,
                    .surface = {}};
    for (int octave = 0; octave < 9; ++octave) row.curve.push_back({256.0 * std::exp2(octave), 40.0 + 5.0 * octave});
    row.numbers = {{"flipped_faces", 0}, {"level", 4}, {"psnr_db at 512 bytes", 45.0}, {"remesh_error", 1e-4}};
    row.times = {{"time parameterize", 100.0}};
    run.rows.push_back(row);
  }
  return run;
}

// The movements of a run in which `edit` changed the first row.
template <class Edit>
CheckResult after(Edit edit, const CheckOptions& options = {}) {
  Baseline run = sample_run();
  edit(run.rows.front());
  return check(sample_run(), run, options);
}

}  // namespace

TEST_CASE("a run passes against itself, also by way of a file") {
  const TemporaryFolder folder;
  const Baseline run = sample_run();
  write_baseline(folder.file("b.json"), run);
  const CheckResult result = check(read_baseline(folder.file("b.json")), run, {});
  CHECK(result.passed());
  CHECK(result.moved.empty());
  CHECK(result.compared == 2 * (4 + 1 + 1));
  CHECK(result.without_bd == 0);
  CHECK_THROWS_AS(read_baseline(folder.file("none.json")), Error);
}

TEST_CASE("what got worse by more than it may fails the check and is named") {
  const CheckResult worse = after([](BaselineRow& row) {
    row.numbers["psnr_db at 512 bytes"] -= 0.05;
    row.numbers["flipped_faces"] = 1;
    row.times["time parameterize"] = 250.0;
  });
  CHECK_FALSE(worse.passed());
  REQUIRE(worse.moved.size() == 3);
  for (const Movement& movement : worse.moved) {
    CHECK(movement.label == "gsp");
    CHECK(movement.verdict == Verdict::Regressed);
  }
  CHECK(junit_report(worse, "smoke").find("tests=\"2\" failures=\"1\"") != std::string::npos);
  CHECK(after([](BaselineRow& row) { row.times["time parameterize"] = 250.0; }, {.times = false}).passed());
  CHECK(after([](BaselineRow& row) { row.numbers["psnr_db at 512 bytes"] -= 0.005; }).moved.empty());
}

TEST_CASE("improvements and new rows are told and pass; what may not change fails either way") {
  const CheckResult better = after([](BaselineRow& row) {
    row.numbers["psnr_db at 512 bytes"] += 1.0;
    row.numbers["remesh_error"] = 5e-5;
  });
  CHECK(better.passed());
  CHECK(better.moved.size() == 2);
  CHECK_FALSE(after([](BaselineRow& row) { row.numbers["level"] = 5; }).passed());
  CHECK_FALSE(after([](BaselineRow& row) { row.options["gamma"] = "0"; }).passed());
  Baseline more = sample_run();
  more.rows.push_back(more.rows.front());
  more.rows.back().label = "draco";
  CHECK(check(sample_run(), more, {}).passed());
  CHECK(check(sample_run(), more, {}).moved.size() == 1);
}

TEST_CASE("an option that is newer than the baseline had its default then") {
  CHECK(after([](BaselineRow& row) { row.options["mode"] = "embedded"; }).moved.empty());
  const CheckResult other = after([](BaselineRow& row) { row.options["mode"] = "fixed"; });
  CHECK_FALSE(other.passed());
  REQUIRE(other.moved.size() == 1);
  CHECK(other.moved[0].what == "option mode");
  CHECK(other.moved[0].before == "embedded");
  CHECK_FALSE(after([](BaselineRow& row) { row.options["no such option"] = "1"; }).passed());
}

TEST_CASE("missing rows, new failures and numbers that are no more fail the check") {
  Baseline run = sample_run();
  run.rows.pop_back();
  CHECK_FALSE(check(sample_run(), run, {}).passed());
  CHECK_FALSE(after([](BaselineRow& row) { row.cause = "invalid-map"; }).passed());
  CHECK_FALSE(after([](BaselineRow& row) { row.numbers.erase("level"); }).passed());
  CHECK_FALSE(
      after([](BaselineRow& row) { row.numbers["remesh_error"] = std::numeric_limits<double>::quiet_NaN(); }).passed());
}

TEST_CASE("a curve that needs more bytes is a BD-rate regression by just that share") {
  const CheckResult dearer = after([](BaselineRow& row) {
    for (RatePoint& point : row.curve) point.bytes *= 1.1;
  });
  REQUIRE(dearer.moved.size() == 1);
  CHECK(dearer.moved.front().what == "bd_rate");
  CHECK(std::stod(dearer.moved.front().after) == Approx(10.0));
  CHECK_FALSE(dearer.passed());
  const CheckResult apart = after([](BaselineRow& row) {
    for (RatePoint& point : row.curve) point.psnr_db -= 60.0;
  });
  CHECK_FALSE(apart.passed());
  CHECK(apart.moved.front().after.find("do not overlap") != std::string::npos);
}

TEST_CASE("infinite numbers are compared as such, also by way of a file") {
  const double exact = std::numeric_limits<double>::infinity();
  const auto with = [](double psnr, double last) {
    Baseline run = sample_run();
    run.rows.front().numbers["psnr_db at 512 bytes"] = psnr;
    run.rows.front().curve.back().psnr_db = last;
    run.rows.front().ceiling_db = last;
    return run;
  };
  const TemporaryFolder folder;
  const Baseline infinite = with(exact, exact);
  write_baseline(folder.file("b.json"), infinite);
  const Baseline read = read_baseline(folder.file("b.json"));
  CHECK(read.rows.front().numbers.at("psnr_db at 512 bytes") == exact);
  CHECK(read.rows.front().curve.back().psnr_db == exact);
  CHECK(*read.rows.front().ceiling_db == exact);
  const CheckResult same = check(read, infinite, {});
  CHECK(same.passed());
  CHECK(same.moved.empty());
  const CheckResult worse = check(infinite, sample_run(), {});
  CHECK_FALSE(worse.passed());
  REQUIRE_FALSE(worse.moved.empty());
  CHECK(worse.moved.front().what == "psnr_db at 512 bytes");
  CHECK(worse.moved.front().before == "exact");
  CHECK(check(sample_run(), infinite, {}).passed());
}

TEST_CASE("a check that compares no number fails, and says so in JUnit too") {
  Baseline nothing = sample_run();
  for (BaselineRow& row : nothing.rows) {
    row.numbers.clear();
    row.times.clear();
    row.curve.clear();
  }
  const CheckResult result = check(nothing, nothing, {});
  CHECK(result.compared == 0);
  CHECK_FALSE(result.passed());
  CHECK(result.moved.front().what == "numbers compared");
  CHECK(junit_report(result, "smoke").find("tests=\"3\" failures=\"1\"") != std::string::npos);
  CHECK_FALSE(check(baseline_of("none", {}), sample_run(), {}).passed());
}

TEST_CASE("a number that the baseline lacks is told, and passes") {
  const CheckResult more = after([](BaselineRow& row) { row.numbers["l2_stretch"] = 1.1; });
  CHECK(more.passed());
  REQUIRE(more.moved.size() == 1);
  CHECK(more.moved.front().verdict == Verdict::Added);
}

TEST_CASE("another surface is called that, not a regression of its numbers") {
  Baseline before = sample_run(), now = sample_run();
  for (BaselineRow& row : before.rows) row.surface = "abc";
  for (BaselineRow& row : now.rows) row.surface = "abc";
  const TemporaryFolder folder;
  write_baseline(folder.file("b.json"), before);
  CHECK(check(read_baseline(folder.file("b.json")), now, {}).moved.empty());
  now.rows.front().surface = "def";
  now.rows.front().numbers["psnr_db at 512 bytes"] = 20.0;
  const CheckResult other = check(read_baseline(folder.file("b.json")), now, {});
  CHECK_FALSE(other.passed());
  REQUIRE(other.moved.size() == 1);
  CHECK(other.moved.front().what == "another surface");
  CHECK(other.moved.front().verdict == Verdict::Changed);
  // A baseline from before surfaces were noted compares as it did.
  CHECK_FALSE(check(sample_run(), now, {}).passed());
  CHECK(check(sample_run(), now, {}).moved.front().what == "psnr_db at 512 bytes");
}

TEST_CASE("what is no baseline is refused in our words, with the line or the key") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    std::ofstream(folder.file("b.json")) << text;
    try {
      read_baseline(folder.file("b.json"));
    } catch (const Error& error) {
      CHECK(error.cause() == Cause::Malformed);
      CHECK(std::string(error.what()).find("json.exception") == std::string::npos);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(refusal("{\n\"gsp_baseline\": 1,\n!}").find("line 3") != std::string::npos);
  CHECK(refusal("").find("no JSON") != std::string::npos);
  CHECK(refusal("[1, 2]").find("gsp_baseline") != std::string::npos);
  CHECK(refusal("{\"gsp_baseline\": \"x\"}").find("gsp_baseline") != std::string::npos);
  CHECK(refusal("{\"gsp_baseline\": 1, \"recipe\": \"r\", \"version\": \"v\", \"tolerances\": {}, \"rows\": [{}]}")
            .find("model") != std::string::npos);
  CHECK(refusal("{\"gsp_baseline\": 1, \"recipe\": \"r\", \"version\": \"v\", \"tolerances\": [3], \"rows\": {}}") !=
        "accepted");
}

namespace {

// A cell of a run of replicates: a straight curve that chance moves up or down, with a remesh of that error.
StoredCell replicate(int number, double moved_db, double remesh_error) {
  StoredCell cell;
  cell.model = "torus";
  cell.label = "gsp";
  cell.options.parameterize.replicate = number;
  cell.options.budgets = {512, 2048};
  cell.status = CellStatus::Done;
  StageResult remesh, measure;
  remesh.kind = StageKind::Remesh;
  remesh.numbers = {{"remesh_error", remesh_error}, {"level", 4}};
  measure.kind = StageKind::Measure;
  for (int octave = 0; octave < 9; ++octave) {
    CurvePoint& point = measure.points.emplace_back();
    point.bytes = std::size_t{256} << octave;
    point.psnr_db = 40.0 + 5.0 * octave + moved_db;
  }
  cell.stages = {remesh, measure};
  return cell;
}

}  // namespace

TEST_CASE("a baseline of replicates is their mean with their deviations, also by way of a file") {
  const std::vector<double> moves = {0.3, -0.1, 0.0, -0.2};
  std::vector<StoredCell> cells;
  for (int r = 0; r < 4; ++r) cells.push_back(replicate(r, moves[r], 1e-5 * (1.0 + 0.01 * r)));
  const TemporaryFolder folder;
  write_baseline(folder.file("b.json"), baseline_of("smoke", cells));
  const Baseline baseline = read_baseline(folder.file("b.json"));
  REQUIRE(baseline.rows.size() == 1);
  const BaselineRow& row = baseline.rows.front();
  CHECK(row.replicates == 4);
  CHECK(row.options.count("replicate") == 0);
  CHECK(row.numbers.at("psnr_db at 512 bytes") == Approx(45.0));
  CHECK(row.deviations.at("psnr_db at 512 bytes") == Approx(std::sqrt(0.14 / 3.0)));
  CHECK(row.numbers.at("remesh_error") == Approx(1.015e-5));
  CHECK(row.deviations.count("level") == 0);
  // 5 dB an octave: a tenth of a dB is 1/50 of an octave, 1.4%.
  CHECK(row.deviations.at("bd_rate") == Approx(std::sqrt(0.14 / 3.0) / 5.0 * std::log(2.0) * 100.0).epsilon(0.03));
  CHECK(row.curve[1].psnr_db == Approx(45.0));
}

TEST_CASE("what is exact in some replicates alone is in no mean, and what is exact in all stays exact") {
  std::vector<StoredCell> cells = {replicate(0, 0.0, 1e-5), replicate(1, 0.2, 1e-5)};
  const auto make_exact = [](StoredCell& cell, std::size_t from) {
    for (CurvePoint& point : cell.stages.back().points)
      if (point.bytes >= from) point.psnr_db = std::numeric_limits<double>::infinity();
  };
  make_exact(cells[0], 2048);
  const BaselineRow some = baseline_of("smoke", cells).rows.front();
  CHECK(some.numbers.at("psnr_db at 512 bytes") == Approx(45.1));
  CHECK(some.numbers.count("psnr_db at 2048 bytes") == 0);
  CHECK(some.deviations.count("psnr_db at 2048 bytes") == 0);
  CHECK(some.curve.back().bytes == 1024.0);

  make_exact(cells[1], 2048);
  const TemporaryFolder folder;
  write_baseline(folder.file("b.json"), baseline_of("smoke", cells));
  const Baseline all = read_baseline(folder.file("b.json"));
  CHECK(all.rows.front().numbers.at("psnr_db at 2048 bytes") == std::numeric_limits<double>::infinity());
  CHECK(all.rows.front().deviations.count("psnr_db at 2048 bytes") == 0);
  CHECK(*exact_from(all.rows.front().curve) == 2048.0);
  CHECK(check(all, baseline_of("smoke", cells), {}).passed());
}

TEST_CASE("what chance explains is no regression, and what it does not is one") {
  const std::vector<double> moves = {0.3, -0.1, 0.0, -0.2, 0.25, -0.25, 0.1, -0.1};
  std::vector<StoredCell> cells;
  for (int r = 0; r < 8; ++r) cells.push_back(replicate(r, moves[r], 1e-5));
  const Baseline baseline = baseline_of("smoke", cells);
  // Numbers that chance may decide: three, level, and the BD-rate.
  const double deviation = baseline.rows.front().deviations.at("psnr_db at 512 bytes");
  const double quantile = student_quantile(1.0 - 0.025 / 5.0, 7.0);
  const auto passes = [&](double moved_db, int replicates) {
    std::vector<StoredCell> run;
    for (int r = 0; r < replicates; ++r) run.push_back(replicate(100 + r, moved_db, 1e-5));
    return check(baseline, baseline_of("smoke", run), {}).passed();
  };
  const double one = quantile * deviation * std::sqrt(1.0 / 8.0 + 1.0), four = quantile * deviation * std::sqrt(0.375);
  CHECK(passes(-0.97 * one, 1));
  CHECK_FALSE(passes(-1.03 * one, 1));
  CHECK(passes(-0.97 * four, 4));
  CHECK_FALSE(passes(-1.03 * four, 4));
}
