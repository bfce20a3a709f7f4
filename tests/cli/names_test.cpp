#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "cli.h"
#include "experiments/curve/curve_csv.h"
#include "experiments/output/quoting.h"
#include "mesh/io.h"
#include "mesh/random.h"
#include "mesh/read_file.h"
#include "mesh/shapes.h"
#include "process.h"
#include "temporary_folder.h"

using namespace gsp;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// Names that run a command where anything takes them for code, each with random bytes 1 to 255 behind.
std::set<std::string> hostile_names(int count) {
  const std::string heads[] = {"$(touch canary)",
                               "`touch canary`",
                               "'; touch canary; '",
                               "\"\nsystem \"touch canary\"\n",
                               "\n! touch canary\n",
                               "<img src=x onerror=alert(1)>",
                               "%s%n",
                               "#?&%41",
                               "--",
                               "*",
                               ""};
  Random random(14);
  std::set<std::string> names;
  for (int i = 0; static_cast<int>(names.size()) < count; ++i) {
    std::string name = heads[static_cast<std::size_t>(i) % std::size(heads)];
    const int bytes = 1 + static_cast<int>(random.uniform() * 24.0);
    for (int k = 0; k < bytes; ++k) {
      const char byte = static_cast<char>(1 + static_cast<int>(random.uniform() * 255.0));
      name += byte == '/' ? '|' : byte;
    }
    names.insert(name);
  }
  return names;
}

/// Makes a folder the working one, and has programs found there before elsewhere, until its end.
class Within {
 public:
  Within(const fs::path& folder, const std::string& path) : before_(fs::current_path()), path_(std::getenv("PATH")) {
    fs::current_path(folder);
    ::setenv("PATH", path.c_str(), 1);
  }
  ~Within() {
    fs::current_path(before_);
    ::setenv("PATH", path_.c_str(), 1);
  }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

 private:
  fs::path before_;
  std::string path_;
};

/// A gnuplot that writes a line to `drawn` for each start.
void write_counting_gnuplot(const fs::path& folder) {
  const fs::path program = folder / "gnuplot";
  std::ofstream(program) << "#!/bin/sh\necho >> '" << (folder / "drawn").string()
                         << "'\nPATH=$(echo \"$PATH\" | cut -d: -f2-)\n"
                         << "exec gnuplot \"$@\"\n";
  fs::permissions(program, fs::perms::owner_all);
}

std::ptrdiff_t lines_of(const fs::path& path) {
  if (!fs::exists(path)) return 0;
  const std::string text = read_file(path.string());
  return std::count(text.begin(), text.end(), '\n');
}

/// What the page shows, as its script reads it.
json page_data(const std::string& page) {
  const std::string text = read_file(page), opening = "<script type=\"application/json\" id=\"run\">";
  const std::size_t begin = text.find(opening) + opening.size();
  return json::parse(text.substr(begin, text.find("</script", begin) - begin));
}

std::set<std::string> models_of(const std::string& csv) {
  std::set<std::string> models;
  for (const CurvePoint& point : read_curve_csv(csv)) models.insert(point.model);
  return models;
}

const std::vector<std::string> kCheapest = {"--budgets", "64,128", "--samples", "1000",
                                            "--level",   "1",      "--quiet",   "--no-anchors"};

}  // namespace

TEST_CASE("51 hostile names pass through sweep, report and curve: nothing runs, the page holds, few gnuplots start",
          "[slow]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "work");
  const Within within(folder.path() / "work", folder.path().string() + ":" + std::getenv("PATH"));
  write_counting_gnuplot(folder.path());
  const std::set<std::string> names = hostile_names(51);
  std::vector<std::string> files;
  for (const std::string& name : names) files.push_back("in/" + name + ".off");
  fs::create_directory("in");
  write_mesh("in/a.off", shapes::torus(8, 6));
  for (const std::string& file : files) fs::copy_file("in/a.off", file);
  fs::remove("in/a.off");
  std::ofstream("r.toml") << "models = [\"x.off\"]\nmethod = [\"gsp\"]\nbase_vertices = 8\nbudgets = [64, 128]\n"
                             "samples = 1000\nlevel = 1\n";

  std::string sweep = "sweep r.toml --store st --quiet --models";
  for (const std::string& file : files) sweep += ' ' + shell_word(file);
  const Ran swept = gsp_process(sweep, folder);  // a sweep starts the program itself for its workers
  CAPTURE(swept.err);
  REQUIRE(swept.status == 0);
  CHECK(models_of("st/curve.csv") == names);

  const Ran report = gsp_run({"report", "st", "-o", "rep", "--map-models", "2"});
  REQUIRE(report.status == 0);
  CHECK(contains(report.err, "the maps of 2 of 51 models are drawn (--map-models)"));
  CHECK(lines_of(folder.path() / "drawn") <= 5);  // twice curves, twice costs, bars
  const json run = page_data("rep/index.html");
  CHECK(run["models"].size() == names.size());
  CHECK(run["figures"].size() == 2 * names.size() + 3 * 2 + 2);
  for (const json& model : run["models"])
    CHECK(std::any_of(names.begin(), names.end(), [&](const std::string& n) { return printable(n) == model["name"]; }));
  for (const json& figure : run["figures"])
    for (const char* kind : {"png", "svg"}) {
      const std::string file = figure[kind];
      if (!file.empty()) CHECK(fs::file_size("rep/" + file) > 500);
    }

  std::vector<std::string> curve = {"curve", "-o", "cv", "--methods", "gsp", "--base-vertices", "8"};
  curve.insert(curve.end(), kCheapest.begin(), kCheapest.end());
  curve.insert(curve.end(), files.begin(), files.end());
  CHECK(gsp_run(curve).status == 0);
  CHECK(models_of("cv/curve.csv") == names);
  CHECK_FALSE(fs::exists("cv/overview.gp"));  // Cairo draws no figure so wide

  for (const auto& entry : fs::recursive_directory_iterator(folder.path())) CHECK(entry.path().filename() != "canary");
}

TEST_CASE("without gnuplot the program of each figure stays in a used folder, and no figure of an earlier run") {
  const TemporaryFolder folder;
  const std::string out = folder.file("out"), none = folder.file("none");
  std::vector<std::string> curve = {"curve",     "shape:torus", "shape:sphere",    "-o", out,
                                    "--methods", "gsp",         "--base-vertices", "12"};
  curve.insert(curve.end(), kCheapest.begin(), kCheapest.end());
  REQUIRE(gsp_run(curve).status == 0);
  const std::vector<std::string> figures = {"torus", "sphere", "overview"};
  for (const std::string& figure : figures)
    for (const char* ending : {".gp", ".png", ".svg"}) REQUIRE(fs::exists(out + "/" + figure + ending));
  fs::create_directory(none);
  const Within within(folder.path(), none);
  const Ran ran = gsp_run(curve);
  CHECK(ran.status == 1);
  CHECK(contains(ran.err, "gnuplot"));
  for (const std::string& figure : figures) {
    CAPTURE(figure);
    CHECK(fs::exists(out + "/" + figure + ".gp"));
    CHECK_FALSE(fs::exists(out + "/" + figure + ".png"));
    CHECK_FALSE(fs::exists(out + "/" + figure + ".svg"));
  }
}
