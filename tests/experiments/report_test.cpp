#include "experiments/report/report.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "experiments/curve/curve_csv.h"
#include "experiments/figures/sector_disc.h"
#include "experiments/report/cost.h"
#include "experiments/report/page.h"
#include "experiments/report/paper.h"
#include "mesh/io.h"
#include "mesh/shapes.h"
#include "metrics/distortion.h"
#include "temporary_folder.h"
#include "test_meshes.h"

using namespace gsp;

namespace {

/// A straight curve on log-bytes: 10 dB a factor of 4, through 50 dB at 1000·`factor` bytes.
std::vector<CurvePoint> straight_curve(const std::string& model, const std::string& method, double factor) {
  std::vector<CurvePoint> points;
  for (int k = 0; k < 5; ++k) {
    CurvePoint point;
    point.model = model;
    point.method = method;
    point.bytes = static_cast<std::size_t>(std::lround(1000.0 * factor * std::pow(4.0, k)));
    point.psnr_db = 50.0 + 10.0 * k;
    point.rms = std::pow(10.0, -point.psnr_db / 20.0);
    point.bits_per_vertex = 1.0;
    point.remesh_error = method == "draco" ? 0.0 : 1e-7;
    points.push_back(point);
  }
  return points;
}

void append(std::vector<CurvePoint>& points, const std::vector<CurvePoint>& more) {
  points.insert(points.end(), more.begin(), more.end());
}

/// A cell of a sweep over gamma and mu.
StoredCell setting(const std::string& model, double gamma, double mu, double factor, int replicate = 0) {
  StoredCell cell;
  cell.model = model;
  cell.options.parameterize.gamma = gamma;
  cell.options.parameterize.mu = mu;
  cell.options.parameterize.replicate = replicate;
  cell.label = "gsp gamma=" + std::to_string(gamma) + " mu=" + std::to_string(mu);
  cell.status = CellStatus::Done;
  StageResult measure;
  measure.kind = StageKind::Measure;
  measure.points = straight_curve(model, "gsp", factor);
  cell.stages.push_back(measure);
  return cell;
}

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("curve.csv comes back as it was written, and damage is named with its line") {
  const TemporaryFolder folder;
  const std::string path = folder.file("curve.csv");
  std::vector<CurvePoint> points = straight_curve("a, \"quoted\"\nname", "gsp", 1.0);
  append(points, straight_curve("plain", "draco", 2.0));
  write_curve_csv(path, points);
  const std::vector<CurvePoint> read = read_curve_csv(path);
  REQUIRE(read.size() == points.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    CHECK(read[i].model == points[i].model);
    CHECK(read[i].method == points[i].method);
    CHECK(read[i].bytes == points[i].bytes);
    CHECK(read[i].psnr_db == Approx(points[i].psnr_db).margin(1e-4));
  }
  const std::string text = text_of(path);
  std::ofstream(path) << text.substr(0, text.rfind(",gsp,") + 9);
  CHECK_THROWS_AS(read_curve_csv(path), Error);
  std::ofstream(path) << "model,bytes\nx,1\n";
  CHECK_THROWS_AS(read_curve_csv(path), Error);
}

TEST_CASE("the first sentence says how many bytes the reference saves") {
  const TemporaryFolder folder;
  std::vector<CurvePoint> points = straight_curve("ball", "gsp", 1.0);
  append(points, straight_curve("ball", "maps-smoothed", 1.6));
  append(points, straight_curve("cube", "gsp", 1.0));
  append(points, straight_curve("cube", "maps-smoothed", 2.0));
  write_curve_csv(folder.file("curve.csv"), points);
  const Findings found = findings(read_run(folder.path().string(), {}));
  CHECK(found.reference == "gsp");
  CHECK(*found.comparison("ball", "maps-smoothed")->bd_rate == Approx(60.0).margin(0.2));
  // The geometric mean of 1.6 and 2.
  CHECK(found.mean("maps-smoothed")->bd_rate == Approx(78.9).margin(0.2));
  CHECK(found.mean("maps-smoothed")->models == 2);
  REQUIRE(found.sentences.size() == 2);
  CHECK(contains(found.sentences[1], "Each number is of one run"));
  CHECK(found.sentences[0] ==
        "gsp needs 44% fewer bytes than maps-smoothed at equal PSNR, the mean of 2 models (ball −38%, cube −50%).");
  CHECK(saving(100.0) == Approx(50.0));
  CHECK(saving(-50.0) == Approx(-100.0));
}

TEST_CASE("a sweep over settings is answered with the best, and by how much") {
  Run run;
  run.name = "gamma-mu";
  for (const char* model : {"ball", "cube"}) {
    run.models.emplace_back().name = model;
    run.cells.push_back(setting(model, 2.0, 1.0, 1.0));
    run.cells.push_back(setting(model, 0.0, 1.0, 1.5));
    run.cells.push_back(setting(model, 1.0, 1.0, 0.8));
  }
  const Findings found = findings(run);
  CHECK(found.reference == run.cells[0].label);
  REQUIRE(found.sentences.size() == 3);
  CHECK(contains(found.sentences[0], "Of 3 settings, " + run.cells[2].label + " needs the fewest bytes"));
  CHECK(contains(found.sentences[0], ": 20.0% fewer than " + run.cells[0].label));
  CHECK(contains(found.sentences[0], run.cells[0].label + ", needs 25.0% more than it"));
  CHECK(contains(found.sentences[0], " (ball −20.0%, cube −20.0%)"));
  CHECK(contains(found.sentences[1], "ball: " + run.cells[2].label + " (−20.0%)"));
  run.cells[3].status = CellStatus::Failed;
  run.cells[3].cause = "invalid-map";
  CHECK(contains(findings(run).sentences.back(), "1 of 6 cells failed"));
}

TEST_CASE("with replicates a number has its interval, and what chance may have made is no difference") {
  // Chance moves both curves of a replicate by up to 20%, their ratio by up to 2%.
  const std::vector<double> chance = {1.0, 1.2, 0.9, 1.1}, noise = {1.0, 1.02, 0.98, 1.01};
  const auto sentences = [&](double factor, double scatter) {
    std::vector<CurvePoint> points;
    for (int r = 0; r < 4; ++r)
      for (const char* method : {"gsp", "maps"}) {
        const bool gsp = std::string(method) == "gsp";
        auto curve = straight_curve("ball", method, chance[r] * (gsp ? 1.0 : factor * std::pow(noise[r], scatter)));
        for (CurvePoint& point : curve) point.replicate = r;
        append(points, curve);
      }
    const TemporaryFolder folder;
    write_curve_csv(folder.file("curve.csv"), points);
    return findings(read_run(folder.path().string(), {})).sentences;
  };
  const std::string saves = sentences(1.5, 1.0)[0], alike = sentences(1.005, 1.0)[0];
  CAPTURE(saves, alike);
  // Student's t of three degrees of freedom: 5.4% wide in bytes, 3.6 points of what is saved.
  CHECK(contains(saves,
                 "gsp needs 33% fewer bytes (31 to 35%) than maps at equal PSNR on ball, the mean of 4 replicates."));
  CHECK(contains(alike, "Between gsp and maps no difference in bytes at equal PSNR can be told (−0.7%, −3."));
}

TEST_CASE("a setting is best only where its interval says so, else those like it are named") {
  Run run;
  run.name = "gamma-mu";
  const std::vector<double> noise = {1.0, 1.02, 0.98, 1.01};
  // Models differ by as much as replicates do.
  const std::vector<std::string> models = {"ball", "cube", "torus", "horse"};
  for (int m = 0; m < 4; ++m) {
    run.models.emplace_back().name = models[m];
    for (int r = 0; r < 4; ++r) {
      run.cells.push_back(setting(models[m], 2.0, 1.0, 1.0, r));
      run.cells.push_back(setting(models[m], 0.0, 1.0, 1.5 * noise[3 - m] * noise[r], r));
      run.cells.push_back(setting(models[m], 1.0, 1.0, 0.999 * noise[m] * noise[3 - r], r));
      run.cells.push_back(setting(models[m], 4.0, 1.0, 1.3 * noise[(m + 1) % 4] * noise[r], r));
    }
  }
  const std::string like = run.cells[2].label, standard = run.cells[0].label;
  const std::vector<std::string> told = findings(run).sentences;
  CAPTURE(told[0]);
  CHECK(contains(told[0], "Of 4 settings none is best for sure"));
  CHECK(contains(told[0], "cannot be told from it; 2 need more for sure, the least of them " + run.cells[3].label));
  CHECK((contains(told[0], "; " + standard + " (") || contains(told[0], "; " + like + " (")));

  for (StoredCell& cell : run.cells)
    if (cell.label == like)
      for (CurvePoint& point : cell.stages.back().points) point.bytes = point.bytes * 8 / 10;
  const std::vector<std::string> best = findings(run).sentences;
  CHECK(contains(best[0], "Of 4 settings, " + like +
                              " needs the fewest bytes at equal PSNR, the mean of 4 models and 4 "
                              "replicates"));
  CHECK(contains(best[0], "; the intervals hold all at once with 95%"));
}

TEST_CASE("where no setting beats the reference, the report says so, and of models with nothing to compare nothing") {
  Run run;
  for (const char* model : {"ball", "cube", "torus"}) run.models.emplace_back().name = model;
  run.cells = {setting("ball", 2.0, 1.0, 1.0), setting("ball", 0.0, 1.0, 1.5), setting("cube", 2.0, 1.0, 1.0),
               setting("cube", 0.0, 1.0, 0.8), setting("torus", 2.0, 1.0, 1.0)};
  const std::string reference = run.cells[0].label;
  CHECK(findings(run).sentences[1] == "Best by model, against " + reference +
                                          ": ball: the reference itself; cube: " + run.cells[3].label + " (−20.0%).");
  run.cells[3] = setting("cube", 0.0, 1.0, 1.5);
  CHECK(findings(run).sentences[1] == "No setting is better than " + reference + " on any model.");
}

TEST_CASE("nothing is said of a gain over points of another model") {
  Run run;
  run.models.emplace_back().name = "ball";
  run.cells = {setting("ball", 2.0, 1.0, 1.0), setting("ball", 2.0, 1.0, 1.5)};
  StoredCell& other = run.cells[1];
  other.label = other.options.method = "other";
  other.options.external.emplace().kind = ExternalTool::Kind::Points;
  CHECK(findings(run).comparison("ball", "other")->bd_rate);
  for (CurvePoint& point : other.stages[0].points) point.coder = std::string(kAnotherModel) + "dinosaur";
  const Findings found = findings(run);
  CHECK_FALSE(found.comparison("ball", "other")->bd_rate);
  CHECK(found.sentences[0] == "other is drawn alone: its points are of another model.");
}

TEST_CASE("a report of a curve folder is one page that needs nothing else") {
  const TemporaryFolder folder;
  std::vector<CurvePoint> points = straight_curve("</script>horse", "gsp", 1.0);
  for (CurvePoint& point : points) point.options = "weights=uniform positions=sampled";
  append(points, straight_curve("</script>horse", "draco", 3.0));
  write_curve_csv(folder.file("curve.csv"), points);
  Progress silent;
  const ReportResult result =
      make_report(folder.path().string(), folder.file("report"), {.recipe = {}, .figures = false, .views = 3}, silent);
  const std::string page = text_of(result.files.front());
  CHECK(contains(page, "\\u003c/script>horse"));
  CHECK_FALSE(contains(page, "</script>horse"));
  CHECK_FALSE(contains(page, "@@"));
  CHECK(contains(page, "\"positions\":\"sampled\""));
  CHECK_FALSE(contains(page, "src=\"http"));
  CHECK(contains(page, "needs 67% fewer bytes than draco"));
  CHECK_THROWS_AS(read_run(folder.file("nothing"), {}), Error);
}

TEST_CASE("the two modes of a method in a curve folder are two curves of the report") {
  TemporaryFolder folder;
  std::vector<CurvePoint> points = straight_curve("horse", "gsp", 1.0);
  for (CurvePoint point : straight_curve("horse", "gsp", 0.9)) {
    point.coder = coder_name(StreamMode::Fixed);
    points.push_back(point);
  }
  write_curve_csv(folder.file("curve.csv"), points);
  const Run run = read_run(folder.path().string(), {});
  CHECK(run.labels() == std::vector<std::string>{"gsp", "gsp mode=fixed"});
  for (const StoredCell& cell : run.cells)
    for (const CurvePoint& point : cell.points()) CHECK(point.coder == coder_name(cell.options.mode));
  CHECK(findings(run).reference == "gsp");
}

TEST_CASE("a page holds its parts and the data once") {
  const std::string page = report_page("{\"name\": \"@@style.css@@\"}");
  CHECK(contains(page, "const Viewer ="));
  CHECK(contains(page, "id=\"three\">H4sI"));  // gzip's first bytes
  CHECK(contains(page, "--accent"));
  CHECK(contains(page, "{\"name\": \"@@style.css@@\"}"));
}

TEST_CASE("the stages of the cost are found where they were put") {
  std::vector<OmegaRecord> record;
  for (int n = 50000; n > 100; --n) {
    OmegaRecord r;
    r.remaining_vertices = n;
    const double quality = n > 20000 ? 0.1 * std::pow(50000.0 / n, 0.7) : 0.19 * std::pow(20000.0 / n, 0.1);
    r.shape = quality / n;
    r.metric = (n > 400 ? 0.01 : 0.5) * quality / n;
    record.push_back(r);
  }
  const CostCurve cost = cost_curve(record);
  REQUIRE(cost.second_stage);
  CHECK(*cost.second_stage == Approx(20000.0).epsilon(0.1));
  REQUIRE(cost.third_stage);
  CHECK(*cost.third_stage == Approx(400.0).epsilon(0.1));
  CHECK(cost_curve({}).bins.empty());

  const TemporaryFolder folder;
  write_omega_csv(folder.file("omega.csv"), record);
  CHECK(read_omega_csv(folder.file("omega.csv")).size() == record.size());
  std::ofstream(folder.file("omega.csv"), std::ios::app) << "12,nan,0,0\n";
  CHECK_THROWS_AS(read_omega_csv(folder.file("omega.csv")), Error);
}

TEST_CASE("the spread of a surface is that of its shape") {
  // A sphere's: r² over 4 π r². A unit square's about its middle: 1/6.
  CHECK(*relative_spread(shapes::sphere(5)) == Approx(1.0 / (4.0 * 3.14159265)).epsilon(1e-3));
  Mesh square = shapes::grid(4, 4, 1.0);
  CHECK(*relative_spread(square) == Approx(1.0 / 6.0));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()).matrix();
  for (Vec3& p : square.positions) p = 7.0 * (turn * p) + Vec3(10.0, -3.0, 5.0);
  CHECK(*relative_spread(square) == Approx(1.0 / 6.0));
  CHECK_FALSE(relative_spread(Mesh{}));
}

TEST_CASE("the paper's numbers stand beside its own models, whatever they are called") {
  StoredModel unread;
  unread.name = "horse", unread.vertices = 48485, unread.faces = 96966;
  CHECK_FALSE(paper_remesh_error(unread));
  // As many vertices and faces as the horse has, and another shape.
  Mesh square = shapes::grid(4, 4, 1.0);
  square.positions.resize(48485, Vec3::Zero());
  while (square.face_count() < 96966) square.faces.push_back(square.faces[square.face_count() % 32]);
  CHECK_FALSE(paper_remesh_error(square));
  if (const std::string folder = shared_meshes(); !folder.empty()) {
    Mesh horse = read_mesh(folder + "/paper/horse_48485.ply");
    CHECK(*paper_remesh_error(horse) == Approx(5.16e-5));
    CHECK(*paper_remesh_error(read_mesh(folder + "/paper/horse_48485_gatech_bigendian.ply")) == Approx(5.16e-5));
    CHECK(*paper_remesh_error(read_mesh(folder + "/paper/bunny_34835_69473.ply")) == Approx(4.22e-5));
    CHECK(*paper_remesh_error(read_mesh(folder + "/paper/venus_50002.ply")) == Approx(3.55e-5));
    CHECK(*paper_remesh_error(read_mesh(folder + "/paper/feline_49864.ply")) == Approx(3.54e-5));
    for (Vec3& p : horse.positions) p.x() *= 1.01;
    CHECK_FALSE(paper_remesh_error(horse));
  }
  if (const std::string folder = sample_meshes(); !folder.empty())
    CHECK_FALSE(paper_remesh_error(read_mesh(folder + "/bunny00.off")));
}

TEST_CASE("sector discs are valid maps that keep the disc's symmetry") {
  for (int sectors : {5, 6, 9}) {
    CAPTURE(sectors);
    const Parameterization relaxed = relaxed_sector_disc(sectors, 3), loop = loop_sector_disc(sectors, 3);
    CHECK(check_map(relaxed).valid());
    CHECK(check_map(loop).valid());
    // Every sector is the image of the first one under the disc's rotation: all hold as many faces of their own.
    std::vector<int> inside(relaxed.base.faces.size(), 0);
    for (std::size_t v = 0; v < relaxed.patch.size(); ++v) {
      const auto w = chart_barycentric(relaxed.position[v]);
      inside[relaxed.patch[v]] += std::min({w[0], w[1], w[2]}) > 1e-6;
    }
    for (int count : inside) CHECK(count == inside.front());
  }
  // Six equilateral sectors are flat already.
  CHECK(distortion(relaxed_sector_disc(6, 3)).anisotropy.maximum == Approx(1.0));
}

TEST_CASE("a curve folder of exact surfaces is reported on") {
  const TemporaryFolder folder;
  std::vector<CurvePoint> points = straight_curve("flat", "gsp", 1.0);
  append(points, straight_curve("flat", "draco", 0.5));
  for (CurvePoint& point : points) {
    point.remesh_error = 0.0;
    point.base_vertices = point.method == "gsp" ? 4 : 0;
    point.psnr_db = std::numeric_limits<double>::infinity();
  }
  write_curve_csv(folder.file("curve.csv"), points);
  Progress silent;
  const ReportResult result = make_report(folder.path().string(), folder.file("report"), {}, silent);
  const std::string page = text_of(result.files.front());
  CHECK(contains(page, "\"ceiling_db\":null,\"ceiling_db_reason\":\"infinite"));
  CHECK(contains(page, "\"psnr_db\":null,\"psnr_db_reason\":\"infinite"));
  CHECK(contains(page, "Exact on flat, without any distance: gsp from 1000 bytes, draco from 500 bytes."));
}
