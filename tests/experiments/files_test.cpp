#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "experiments/cells/models.h"
#include "experiments/curve/anchor_curves.h"
#include "experiments/curve/curve_csv.h"
#include "experiments/curve/stages.h"
#include "experiments/curve_job.h"
#include "experiments/output/earlier_run.h"
#include "experiments/plot/gnuplot.h"
#include "experiments/plot/plot.h"
#include "experiments/version.h"
#include "mesh/error.h"
#include "mesh/random.h"
#include "mesh/read_file.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

CurvePoint sample_point(const std::string& model, const std::string& method, std::size_t bytes, double psnr) {
  CurvePoint point;
  point.model = model;
  point.method = method;
  point.bytes = bytes;
  point.psnr_db = psnr;
  point.remesh_error = method == "gsp" ? 1e-4 : 0.0;
  point.version = version();
  point.options = "objective=distortion";
  return point;
}

}  // namespace

TEST_CASE("curve.csv has the columns of the design and one row per point") {
  const TemporaryFolder folder;
  write_curve_csv(folder.file("curve.csv"), {sample_point("horse", "gsp", 1024, 60.5)});
  std::ifstream in(folder.file("curve.csv"));
  std::string header, row, rest;
  std::getline(in, header);
  std::getline(in, row);
  CHECK_FALSE(std::getline(in, rest));
  const auto names = split(header), fields = split(row);
  REQUIRE(names.size() == fields.size());
  for (const char* name : {"model",        "method",  "gamma",     "mu",      "base_vertices",   "base_faces",
                           "level",        "wavelet", "coder",     "bytes",   "bits_per_vertex", "rms_forward",
                           "rms_backward", "rms",     "hausdorff", "psnr_db", "samples",         "standard_error_db",
                           "remesh_error", "seed",    "version"})
    CHECK(std::count(names.begin(), names.end(), name) == 1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == "bytes") CHECK(fields[i] == "1024");
    if (names[i] == "psnr_db") CHECK(fields[i] == "60.5");
    if (names[i] == "version") CHECK(fields[i] == version());
  }
}

TEST_CASE("a byte order mark is no part of a CSV's first column") {
  const TemporaryFolder folder;
  const std::string path = folder.file("curve.csv");
  write_curve_csv(path, {sample_point("horse", "gsp", 1024, 60.5)});
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::ofstream(path) << "\xef\xbb\xbf" << text.str();
  const std::vector<CurvePoint> points = read_curve_csv(path);
  REQUIRE(points.size() == 1);
  CHECK(points[0].model == "horse");
  CHECK(points[0].bytes == 1024);
}

TEST_CASE("a model's name with a comma or a quote stays one field") {
  const TemporaryFolder folder;
  write_curve_csv(folder.file("curve.csv"), {sample_point("a,\"b", "gsp", 1, 1.0)});
  std::ifstream in(folder.file("curve.csv"));
  std::string row;
  std::getline(in, row);
  std::getline(in, row);
  CHECK(row.rfind("\"a,\"\"b\",gsp,", 0) == 0);
}

TEST_CASE("budgets hold the header, stay under the stream and end with the whole of it") {
  CHECK(byte_budgets({}, 300, 3000) == std::vector<std::size_t>{512, 1024, 2048, 3000});
  CHECK(byte_budgets({}, 10, 1024) == std::vector<std::size_t>{256, 512, 1024});
  CHECK(byte_budgets({100, 700, 5000}, 200, 3000) == std::vector<std::size_t>{700, 3000});
  CHECK(byte_budgets({}, 50, 100) == std::vector<std::size_t>{100});
}

TEST_CASE("an infinite PSNR survives curve.csv and ends its curve; the lossless row is on none") {
  const TemporaryFolder folder;
  const double infinite = std::numeric_limits<double>::infinity();
  std::vector<CurvePoint> points = {sample_point("cube", "draco", 100, 60.0),
                                    sample_point("cube", "draco", 200, infinite),
                                    sample_point("cube", "draco", 300, 150.0)};
  points[2].coder = kDracoLossless;
  write_curve_csv(folder.file("curve.csv"), points);
  const std::vector<CurvePoint> read = read_curve_csv(folder.file("curve.csv"));
  REQUIRE(read.size() == 3);
  CHECK(read[1].psnr_db == infinite);
  CHECK(envelope_of(read).size() == 2);
  CHECK(*exact_from(envelope_of(read)) == 200);
  const CurveSummary summary = summarize("cube", curves_of(read));
  CHECK(summary.methods.at(0).lossless_bytes == 300);
}

TEST_CASE("a curve.csv from before there were replicates is read as the first of each") {
  const TemporaryFolder folder;
  CurvePoint point = sample_point("cube", "gsp", 100, 60.0);
  point.replicate = 3;
  write_curve_csv(folder.file("curve.csv"), {point});
  CHECK(read_curve_csv(folder.file("curve.csv")).at(0).replicate == 3);
  std::string text = read_text(folder.file("curve.csv"));
  text.replace(text.find(",replicate,"), 11, ",");
  text.replace(text.rfind(",3,"), 3, ",");
  std::ofstream(folder.file("old.csv")) << text;
  const std::vector<CurvePoint> old = read_curve_csv(folder.file("old.csv"));
  REQUIRE(old.size() == 1);
  CHECK(old[0].replicate == 0);
  CHECK(old[0].bytes == 100);
}

TEST_CASE("decimation sizes fall from the surface itself") {
  const std::vector<int> sizes = decimation_sizes(96000);
  CHECK(sizes.front() == 96000);
  CHECK(sizes[3] == 48000);
  CHECK(sizes[7] == 19049);  // the first under 20,000, from where on they are twice as dense
  CHECK(sizes[13] == 9524);
  CHECK(sizes.back() >= 20);
  CHECK(sizes.back() < 23);
  for (std::size_t i = 1; i < sizes.size(); ++i) CHECK(sizes[i] < sizes[i - 1]);
  CHECK(decimation_sizes(12) == std::vector<int>{12});
}

TEST_CASE("a plot draws strange names, and names the files it made") {
  const TemporaryFolder folder;
  const std::string model = "it's a_model{x}";
  const std::vector<CurvePoint> points = {sample_point(model, "gsp", 256, 40), sample_point(model, "gsp", 4096, 60),
                                          sample_point(model, "draco", 4096, 30),
                                          sample_point(model, "draco", 90000, 70)};
  const auto files =
      plot(folder.path().string(), "figure", {{model, curves_of(points)}, {"second", curves_of(points)}});
  REQUIRE(files.size() == 3);
  for (const std::string& file : files) CHECK(std::filesystem::file_size(folder.file(file)) > 500);
  const std::string svg = read_file(folder.file("figure.svg"));
  CHECK(svg.find("<text>gsp</text>") != std::string::npos);
  CHECK(svg.find("<text>gsp</text>") == svg.rfind("<text>gsp</text>"));  // one key for both panels
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++entries;
  CHECK(entries == files.size());
}

TEST_CASE("a method's first label has its colour, and no two of a few labels share one") {
  const auto colors = method_colors({"gsp", "gsp gamma=1", "draco", "other"});
  CHECK(colors[0] == method_colors({"gsp gamma=2"}).front());
  CHECK(std::set<std::string>(colors.begin(), colors.end()).size() == 4);
}

TEST_CASE("folders stand for the surfaces in them, in name order") {
  const TemporaryFolder folder;
  for (const char* name : {"b.ply", "a.OFF", "notes.txt", "c.stl"}) std::ofstream(folder.file(name)) << "x";
  const auto files = surface_files({"single.obj", folder.path().string()});
  REQUIRE(files.size() == 4);
  CHECK(files[0] == "single.obj");
  CHECK(files[1] == folder.file("a.OFF"));
  CHECK(files[2] == folder.file("b.ply"));
  CHECK(files[3] == folder.file("c.stl"));
  const TemporaryFolder empty;
  CHECK_THROWS_AS(surface_files({empty.path().string()}), Error);
}

TEST_CASE("numbers of curve.csv read back to the last bit, and names to the last byte") {
  const TemporaryFolder folder;
  Random random(5);
  std::vector<CurvePoint> points;
  for (int i = 0; i < 1000; ++i) {
    std::string name;
    for (int k = 0; k < 20; ++k) name += static_cast<char>(1 + static_cast<int>(random.uniform() * 255.0));
    CurvePoint point = sample_point(name, "gsp", 1 + static_cast<std::size_t>(1e6 * random.uniform()), 0.0);
    for (double* number : {&point.gamma, &point.mu, &point.bits_per_vertex, &point.rms_forward, &point.rms_backward,
                           &point.rms, &point.hausdorff, &point.psnr_db, &point.standard_error_db, &point.remesh_error})
      *number = std::exp(40.0 * random.uniform() - 30.0);
    points.push_back(point);
  }
  write_curve_csv(folder.file("curve.csv"), points);
  const std::vector<CurvePoint> read = read_curve_csv(folder.file("curve.csv"));
  REQUIRE(read.size() == points.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    const CurvePoint &a = points[i], &b = read[i];
    CHECK((a.model == b.model && a.bytes == b.bytes && a.gamma == b.gamma && a.mu == b.mu));
    CHECK(
        (a.bits_per_vertex == b.bits_per_vertex && a.rms_forward == b.rms_forward && a.rms_backward == b.rms_backward));
    CHECK((a.rms == b.rms && a.hausdorff == b.hausdorff && a.psnr_db == b.psnr_db));
    CHECK((a.standard_error_db == b.standard_error_db && a.remesh_error == b.remesh_error));
  }
}

TEST_CASE("a surface is one, however its path is spelled; names of links and shapes stay names") {
  const TemporaryFolder folder;
  std::ofstream(folder.file("m.off")) << "x";
  std::filesystem::create_symlink("m.off", folder.path() / "link.off");
  const std::string path = folder.path().string();
  const auto files = surface_files(
      {path + "/m.off", path + "/./m.off", path + "/../" + folder.path().filename().string() + "/m.off", path});
  REQUIRE(files.size() == 2);
  CHECK(files[0] == path + "/m.off");
  CHECK(files[1] == path + "/link.off");
  CHECK(surface_place("m.off") == surface_place("./m.off"));
  CHECK(surface_place("m.off") == surface_place(std::filesystem::current_path().string() + "/m.off"));
  CHECK(surface_place("shape:torus") == "shape:torus");
}

TEST_CASE("a file whose name looks like a pattern is found, and a pattern without files says where it looked") {
  const TemporaryFolder folder;
  std::ofstream(folder.file("a[1]*.off")) << "x";
  CHECK(matching_models(folder.file("a[1]*.off")) == std::vector<std::string>{folder.file("a[1]*.off")});
  try {
    matching_models("no-such-folder/*.ply");
    FAIL("nothing matches");
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find(std::filesystem::current_path().string()) != std::string::npos);
  }
}

TEST_CASE("exact points round trip by curve.csv, and curves without any height are drawn") {
  const TemporaryFolder folder;
  const double exact = std::numeric_limits<double>::infinity();
  const std::vector<CurvePoint> points = {sample_point("cube", "gsp", 300, exact),
                                          sample_point("cube", "draco", 200, exact)};
  write_curve_csv(folder.file("curve.csv"), points);
  const std::vector<CurvePoint> read = read_curve_csv(folder.file("curve.csv"));
  REQUIRE(read.size() == 2);
  CHECK(read[0].psnr_db == exact);
  plot(folder.path().string(), "flat", {{"cube", curves_of(points)}});
  CHECK(read_file(folder.file("flat.svg")).find("exact from 200 bytes") != std::string::npos);
  plot(folder.path().string(), "both", {{"cube", curves_of(points)}, {"again", curves_of(points)}});
  std::string text = read_file(folder.file("curve.csv"));
  text.replace(text.find(",inf,"), 5, ",nan,");
  std::ofstream(folder.file("curve.csv")) << text;
  CHECK_THROWS_AS(read_curve_csv(folder.file("curve.csv")), Error);
}

TEST_CASE("what an earlier run left goes where it is not made again, and nothing else") {
  const TemporaryFolder folder;
  const std::string root = folder.path().string();
  write_curve_csv(folder.file("curve.csv"),
                  {sample_point("a/b", "gsp", 1024, 60.5), sample_point("cow", "gsp", 64, 40.0),
                   sample_point("cow", "maps", 64, 40.0)});
  const std::set<std::string> stems = stems_of_earlier_run(root);
  CHECK(stems.size() == 2);
  CHECK(stems.count("cow") == 1);
  CHECK(stems_of_earlier_run(root + "/none").empty());
  for (const char* name : {"cow.png", "cow.gp", "cow.csv", "horse.png", "mine.png"})
    std::ofstream(folder.file(name)) << 1;
  std::vector<std::string> names = figure_files("cow");
  names.push_back("horse.png");
  names.push_back("never.png");
  remove_stale(root, names, {root + "/horse.png"});
  std::set<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(root)) left.insert(entry.path().filename().string());
  CHECK(left == std::set<std::string>{"cow.csv", "curve.csv", "horse.png", "mine.png"});
}
