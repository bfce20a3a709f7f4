#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli.h"
#include "experiments/cells/cell_options.h"
#include "mesh/io.h"
#include "mesh/read_file.h"
#include "mesh/shapes.h"
#include "param/map/param_file.h"
#include "support/exact_maps.h"
#include "temporary_folder.h"

using namespace gsp;
using nlohmann::json;

namespace {

std::string write_bumpy(const TemporaryFolder& folder) {
  const std::string path = folder.file("bumpy.ply");
  write_mesh(path, shapes::bumpy_sphere(4));
  return path;
}

std::size_t size_of(const std::string& path) { return static_cast<std::size_t>(std::filesystem::file_size(path)); }

std::size_t files_in(const TemporaryFolder& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++count;
  return count;
}

}  // namespace

TEST_CASE("info describes a usable surface with status 0, for people and for programs") {
  const TemporaryFolder folder;
  const std::string path = folder.file("torus.off");
  write_mesh(path, shapes::torus(12, 8));
  const Ran text = gsp_run({"info", path});
  CHECK(text.status == 0);
  CHECK(contains(text.out, "genus 1"));
  const Ran ran = gsp_run({"info", path, "--json"});
  CHECK(ran.status == 0);
  const json report = json::parse(ran.out);
  CHECK(report["program"] == "gsp");
  CHECK(report["vertices"] == 96);
  CHECK(report["faces"] == 192);
  CHECK(report["components"] == 1);
  CHECK(report["component_list"][0]["genus"] == 1);
  CHECK(report["usable"] == true);
}

TEST_CASE("info says why a surface cannot be used, with the place, and status 3") {
  const TemporaryFolder folder;
  const std::string path = folder.file("fan.off");
  std::ofstream(path) << "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n";
  const Ran ran = gsp_run({"info", path, "--json"});
  CHECK(ran.status == 3);
  const json report = json::parse(ran.out);
  CHECK(report["usable"] == false);
  CHECK(report["refusal"]["cause"] == "non-manifold-edge");
  CHECK_FALSE(report["refusal"]["message"].get<std::string>().empty());
  CHECK(contains(gsp_run({"info", path}).out, "non-manifold-edge"));
  const Ran refused = gsp_run({"parameterize", path, "-o", folder.file("map.param.ply")});
  CHECK(refused.status == 3);
  CHECK(contains(refused.err, "gsp: "));
  CHECK_FALSE(std::filesystem::exists(folder.file("map.param.ply")));
}

TEST_CASE("every command that reads a file refuses one that is not there with status 3") {
  const TemporaryFolder folder;
  const std::string missing = folder.file("missing.ply"), output = folder.file("output.ply");
  for (const std::vector<std::string>& args :
       std::vector<std::vector<std::string>>{{"info", missing},
                                             {"parameterize", missing, "-o", output},
                                             {"remesh", missing, "-o", output},
                                             {"encode", missing, "-o", folder.file("output.pgc")},
                                             {"decode", missing, "-o", output},
                                             {"distance", missing, missing},
                                             {"distortion", missing}}) {
    CAPTURE(args.front());
    CHECK(gsp_run(args).status == 3);
  }
  CHECK(files_in(folder) == 0);
}

TEST_CASE("a preset sets what the line does not say, wherever it stands") {
  const TemporaryFolder folder;
  const std::string mesh = write_bumpy(folder), map = folder.file("map.param.ply");
  const auto made = [&](const std::vector<std::string>& more) {
    std::vector<std::string> line = {"parameterize", mesh, "-o", map, "--base-vertices", "40", "--json"};
    line.insert(line.end(), more.begin(), more.end());
    const Ran ran = gsp_run(line);
    CAPTURE(ran.err);
    REQUIRE(ran.status == 0);
    return json::parse(ran.out);
  };
  const json paper = made({"--preset", "paper"});
  CHECK(paper["objective"] == "linear");
  CHECK(paper["weights"] == "mean-value");
  const json varied = made({"--weights", "cotangent", "--preset", "paper"});
  CHECK(varied["base_vertices"] == 40);
  CHECK(varied["objective"] == "linear");
  CHECK(varied["weights"] == "cotangent");
  CHECK(made({})["objective"] == "distortion");
}

TEST_CASE("a profile names the steps of a map, and leaves the map the same bytes") {
  const TemporaryFolder folder;
  const std::string mesh = write_bumpy(folder), map = folder.file("map.param.ply"),
                    timed = folder.file("timed.param.ply");
  REQUIRE(gsp_run({"parameterize", mesh, "-o", map, "--base-vertices", "40"}).status == 0);
  const Ran ran = gsp_run({"parameterize", mesh, "-o", timed, "--base-vertices", "40", "--profile", "--json"});
  REQUIRE(ran.status == 0);
  CHECK(read_file(timed) == read_file(map));
  const json report = json::parse(ran.out), profile = report["profile"];
  REQUIRE(profile.size() > 5);
  CHECK(profile[0]["step"] == "whole");
  double inside = 0.0;
  for (const json& step : profile)
    if (step["depth"] == 1) inside += step["seconds"].get<double>();
  CHECK(inside <= profile[0]["seconds"]);
  CHECK(inside >= 0.9 * profile[0]["seconds"].get<double>());
}

TEST_CASE("the chain of commands: surface, map, remesh, stream, prefix, distance") {
  const TemporaryFolder folder;
  const std::string mesh = write_bumpy(folder), map = folder.file("map.param.ply"), remeshed = folder.file("r.sr.ply"),
                    stream = folder.file("c.pgc"), decoded = folder.file("d.sr.ply"), omega = folder.file("omega.csv");

  const Ran made = gsp_run({"parameterize", mesh, "-o", map, "--base-vertices", "40", "--omega-csv", omega,
                            "--omega-plot", folder.file("cost.png"), "--check", "--json"});
  CAPTURE(made.err);
  REQUIRE(made.status == 0);
  const json report = json::parse(made.out);
  CHECK(report["base_vertices"] == 40);
  CHECK(report["base_faces"] == 76);
  CHECK(report["check"]["valid"] == true);
  CHECK(size_of(omega) > 100);
  CHECK(report["cost_stages_begin"].contains("third"));
  for (const char* figure : {"cost.png", "cost.svg", "cost.gp"}) CHECK(size_of(folder.file(figure)) > 1000);

  const Ran distortion = gsp_run({"distortion", map, "--json", "--per-face", folder.file("faces.csv"), "--picture",
                                  folder.file("faces.ply"), "--colour", "smoothness"});
  REQUIRE(distortion.status == 0);
  const json measured = json::parse(distortion.out);
  CHECK(measured["check"]["flipped_faces"] == 0);
  CHECK(measured["anisotropy"]["mean"] >= 1.0);
  CHECK(measured["sorkine"]["neutral"] == 1);
  CHECK(measured["l2_stretch_of_map"] >= 1.0);
  CHECK(measured["smoothness"]["inside_patches"]["edges"] > 0);
  CHECK(measured["smoothness"].contains("across_over_inside"));
  CHECK(size_of(folder.file("faces.csv")) > 1000);
  CHECK(size_of(folder.file("faces.ply")) > 1000);

  const Ran finest = gsp_run({"remesh", map, "-o", remeshed, "--positions", "sampled", "--json"});
  REQUIRE(finest.status == 0);
  CHECK(json::parse(finest.out)["level"] >= 5);  // the first with 32,768 faces, or by rate a finer one
  // Four times as fast, and what follows is no different there.
  const std::string level = "4";
  const auto remesh_error = [&](const std::string& positions) {
    const Ran ran = gsp_run({"remesh", map, "-o", remeshed, "--positions", positions, "--level", level, "--json"});
    REQUIRE(ran.status == 0);
    CHECK(json::parse(ran.out)["faces"] == 76 * 256);
    CHECK(json::parse(ran.out)["positions"] == positions);
    // Comments are at the head of the file.
    const std::string head = read_file(remeshed).substr(0, 400);
    CHECK(head.find("comment positions " + positions + "\n") != std::string::npos);
    CHECK(head.find("comment kind parametric\n") != std::string::npos);
    const Ran distance = gsp_run({"distance", mesh, remeshed, "--samples", "20000", "--json"});
    REQUIRE(distance.status == 0);
    return json::parse(distance.out)["rms"].get<double>();
  };
  const double sampled = remesh_error("sampled"), closest = remesh_error("closest"), fitted = remesh_error("fitted");
  CHECK(fitted < 0.8 * sampled);
  CHECK(closest < fitted);
  CHECK(gsp_run({"remesh", map, "-o", remeshed, "--positions", "neither"}).status == 2);

  const std::string scalar = folder.file("nf.sr.ply"), scalars = folder.file("nf.pgc");
  CHECK(gsp_run({"remesh", map, "-o", scalar, "--kind", "normal", "--predict", "loop"}).status == 2);
  const auto tangential_bytes = [&](const std::string& mesh) {
    const Ran code = gsp_run({"encode", mesh, "-o", scalars, "--wavelet", "butterfly-lifted", "--json"});
    REQUIRE(code.status == 0);
    const auto part = json::parse(code.out)["whole_stream_by_part"]["tangential_1"];
    return part["significance"].get<int>() + part["signs"].get<int>() + part["refinement"].get<int>();
  };
  const int parametric_bytes = tangential_bytes(remeshed);
  for (const char* kind : {"normal", "variational-normal"}) {
    REQUIRE(gsp_run({"remesh", map, "-o", scalar, "--kind", kind, "--predict", "butterfly-lifted", "--level", level})
                .status == 0);
    CHECK(tangential_bytes(scalar) < parametric_bytes / 3);
  }
  const std::string normal = folder.file("n.sr.ply");
  REQUIRE(
      gsp_run({"remesh", map, "-o", normal, "--kind", "normal", "--positions", "sampled", "--level", level}).status ==
      0);
  const Ran info = gsp_run({"info", normal, "--json"});
  REQUIRE(info.status == 0);
  CHECK(json::parse(info.out)["normal_percent"] > 90.0);
  CHECK(json::parse(info.out)["boundary_vertices"] == 0);

  const std::string displaced = folder.file("displaced.sr.ply");
  REQUIRE(gsp_run({"remesh", map, "-o", displaced, "--kind", "displaced", "--level", level}).status == 0);
  const Ran displaced_info = gsp_run({"info", displaced, "--json"});
  REQUIRE(displaced_info.status == 0);
  CHECK(json::parse(displaced_info.out)["displaced"]["control_points"] == 40);
  REQUIRE(gsp_run({"encode", displaced, "-o", stream}).status == 0);
  REQUIRE(gsp_run({"decode", stream, "-o", decoded}).status == 0);
  CHECK(json::parse(gsp_run({"info", decoded, "--json"}).out)["kind"] == "displaced");

  const Ran coded = gsp_run({"encode", remeshed, "-o", stream, "--json"});
  REQUIRE(coded.status == 0);
  CHECK(json::parse(coded.out)["bytes"] == size_of(stream));

  const auto psnr = [&](const std::vector<std::string>& options) {
    std::vector<std::string> args = {"decode", stream, "-o", decoded};
    args.insert(args.end(), options.begin(), options.end());
    REQUIRE(gsp_run(args).status == 0);
    const Ran ran = gsp_run({"distance", remeshed, decoded, "--samples", "20000", "--json"});
    REQUIRE(ran.status == 0);
    return json::parse(ran.out)["psnr_db"].get<double>();
  };
  const double whole = psnr({}), part = psnr({"--bytes", "2000"});
  CHECK(whole > 80.0);
  CHECK(part > 35.0);
  CHECK(part < whole);

  // A byte budget is kept, and a target PSNR is reached with fewer bytes than the whole.
  const std::string cut = folder.file("cut.pgc"), fixed = folder.file("fixed.pgc");
  REQUIRE(gsp_run({"encode", remeshed, "-o", cut, "--bytes", "1500"}).status == 0);
  CHECK(size_of(cut) == 1500);
  REQUIRE(gsp_run({"encode", remeshed, "-o", cut, "--psnr", "55"}).status == 0);
  REQUIRE(gsp_run({"encode", remeshed, "-o", fixed, "--mode", "fixed", "--psnr", "55"}).status == 0);
  CHECK(size_of(fixed) < 1.1 * size_of(cut));
  CHECK(gsp_run({"encode", remeshed, "-o", fixed, "--mode", "fixed"}).status == 2);
  CHECK(size_of(cut) < size_of(stream) / 2);
  REQUIRE(gsp_run({"decode", cut, "-o", decoded}).status == 0);
  const Ran reached = gsp_run({"distance", remeshed, decoded, "--json"});
  CHECK(json::parse(reached.out)["psnr_db"].get<double>() > 54.9);

  const Ran never = gsp_run({"encode", remeshed, "-o", folder.file("x.pgc"), "--bytes", "5"});
  CHECK(never.status == 2);
  CHECK_FALSE(std::filesystem::exists(folder.file("x.pgc")));

  // The first level under an error is found.
  const Ran found = gsp_run({"remesh", map, "-o", remeshed, "--max-error", "0.001", "--json"});
  REQUIRE(found.status == 0);
  const int first = json::parse(found.out)["level"];
  CHECK((first >= 1 && first <= 4));
}

TEST_CASE("distance says everything it is asked for, in the same bytes for one and two threads") {
  const TemporaryFolder folder;
  const std::string a = write_bumpy(folder), b = folder.file("plane.ply");
  write_mesh(b, shapes::sphere(3));
  std::vector<std::string> args = {"distance",
                                   a,
                                   b,
                                   "--samples",
                                   "20000",
                                   "--hausdorff-tolerance",
                                   "0.01",
                                   "--metro",
                                   "--mpeg",
                                   "--per-vertex",
                                   folder.file("v.ply"),
                                   "--json",
                                   "--threads",
                                   "1"};
  const Ran one = gsp_run(args);
  CAPTURE(one.err);
  REQUIRE(one.status == 0);
  args.back() = "2";
  CHECK(gsp_run(args).out == one.out);
  const json report = json::parse(one.out);
  CHECK(report["hausdorff_bounds"]["both"]["relative_width"] <= 0.01);
  CHECK(report["hausdorff_bounds"]["both"]["upper"] >= report["hausdorff"]);
  CHECK(report["forward"]["quantile95"] <= report["forward"]["hausdorff"]);
  CHECK(report["metro"]["forward"]["face_samples"] > 0);
  CHECK(report["mpeg_d1"]["formula"].get<std::string>().find("peak") != std::string::npos);
  CHECK(report["mpeg_d2"]["db"].get<double>() >= report["mpeg_d1"]["db"].get<double>() - 0.05);
  CHECK(size_of(folder.file("v.ply")) > 1000);

  const Ran precise = gsp_run({"distance", a, b, "--samples", "1000", "--tolerance-db", "0.01", "--json"});
  REQUIRE(precise.status == 0);
  CHECK(json::parse(precise.out)["standard_error_db"] <= 0.01);
  CHECK(gsp_run({"distance", a, b, "--tolerance-db", "-1"}).status == 2);
}

TEST_CASE("a stream that is none is unusable input") {
  const TemporaryFolder folder;
  std::ofstream(folder.file("noise.pgc")) << std::string(500, 'x');
  CHECK(gsp_run({"decode", folder.file("noise.pgc"), "-o", folder.file("d.ply")}).status == 3);
  std::ofstream(folder.file("empty.pgc")) << "";
  CHECK(gsp_run({"decode", folder.file("empty.pgc"), "-o", folder.file("d.ply")}).status == 3);
  CHECK_FALSE(std::filesystem::exists(folder.file("d.ply")));
}

TEST_CASE("output that cannot be written is a failure, status 1") {
  const TemporaryFolder folder;
  const std::string mesh = write_bumpy(folder);
  CHECK(gsp_run({"parameterize", mesh, "-o", folder.file("no/such/folder/map.param.ply"), "--base-vertices", "40"})
            .status == 1);
}

TEST_CASE("an error is JSON too where JSON is asked for") {
  const Ran ran = gsp_run({"distance", "missing-a.ply", "missing-b.ply", "--json"});
  CHECK(ran.status == 3);
  CHECK(json::parse(ran.out)["error"]["cause"] == "cannot-open");
}

TEST_CASE("curve draws what works, names what fails, and ends with status 1 for it", "[slow]") {
  const TemporaryFolder folder, output;
  const std::string good = write_bumpy(folder), bad = folder.file("bad.off");
  std::ofstream(bad) << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n";
  const std::string to = output.file("curves");
  const Ran ran = gsp_run({"curve", bad, good, "-o", to, "--samples", "5000", "--base-vertices", "30", "--modes",
                           "embedded,fixed", "--kinds", "parametric,displaced", "--level", "4", "--json"});
  CAPTURE(ran.err);
  CHECK(ran.status == 1);
  CHECK(contains(ran.err, "gsp: bad: "));
  const json report = json::parse(ran.out);
  CHECK(report["models"][0]["error"]["cause"].is_string());
  CHECK_FALSE(report["models"][1].contains("error"));
  CHECK(report["models"][1]["methods"][0]["method"] == "gsp");
  CHECK(report["models"][1]["methods"].size() == 2 * 2 * 2 + anchor_words().size());
  CHECK(report["models"][1]["methods"][1]["method"] == "gsp mode=fixed");
  CHECK(report["models"][1]["methods"][1]["coder"] == "gsp-fixed");
  CHECK(report["models"][1]["methods"][2]["method"] == "gsp kind=displaced");
  for (const char* name : {"curve.csv", "bumpy.png", "bumpy.svg", "bumpy-omega.csv"})
    CHECK(size_of(to + "/" + name) > 200);
  for (const auto& file : report["files"]) CHECK(std::filesystem::exists(file.get<std::string>()));
}

TEST_CASE("equal surfaces have an infinite PSNR: null in JSON, with the reason") {
  const TemporaryFolder folder;
  const std::string path = write_bumpy(folder);
  const json report = json::parse(gsp_run({"distance", path, path, "--samples", "2000", "--mpeg", "--json"}).out);
  CHECK(report["psnr_db"].is_null());
  CHECK(report["psnr_db_reason"].get<std::string>().find("exactly") != std::string::npos);
  CHECK(report["mpeg_d1"]["db"].is_null());
  CHECK(report["mpeg_d2"]["db_reason"].is_string());
}

TEST_CASE("creases go through remeshing, coding and decoding, and are counted on the way") {
  const TemporaryFolder folder;
  const std::string map = folder.file("map.param.ply"), remeshed = folder.file("r.sr.ply"),
                    stream = folder.file("c.pgc"), decoded = folder.file("d.sr.ply");
  Parameterization octahedron = exact_maps::quadrisected(shapes::octahedron(), 2);
  const Triangle& t = octahedron.base.faces[0];
  octahedron.base.creases = {{std::min(t[0], t[1]), std::max(t[0], t[1])}};
  write_parameterization(map, octahedron);
  for (const std::vector<std::string>& command : {std::vector<std::string>{"remesh", map, "-o", remeshed, "--json"},
                                                  {"encode", remeshed, "-o", stream, "--json"},
                                                  {"decode", stream, "-o", decoded, "--json"},
                                                  {"info", decoded, "--json"}}) {
    const Ran ran = gsp_run(command);
    REQUIRE(ran.status == 0);
    CHECK(json::parse(ran.out)["crease_edges"] == 1);
  }
}
