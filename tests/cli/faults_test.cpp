#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "cli.h"
#include "mesh/edge.h"
#include "mesh/features/features.h"
#include "mesh/io.h"
#include "mesh/read_file.h"
#include "mesh/shapes.h"
#include "mesh/weld.h"
#include "process.h"
#include "temporary_folder.h"
#include "test_meshes.h"

using namespace gsp;
using nlohmann::json;

namespace {

std::string write(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  const std::string path = folder.file(name);
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// A torus as an OBJ whose every face has corners of its own.
std::string write_soup(const TemporaryFolder& folder) {
  const Mesh torus = shapes::torus(16, 8);
  Mesh soup;
  for (const Triangle& t : torus.faces) {
    for (int v : t) soup.positions.push_back(torus.positions[v]);
    const int last = soup.vertex_count() - 1;
    soup.faces.push_back({last - 2, last - 1, last});
  }
  write_mesh(folder.file("soup.obj"), soup);
  return folder.file("soup.obj");
}

json info(const std::string& path, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"info", path, "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return json::parse(gsp_run(arguments).out);
}

}  // namespace

TEST_CASE("info says what a weld would close and how to ask for it; every command that reads a surface takes it") {
  const TemporaryFolder folder;
  const std::string soup = write_soup(folder);
  const json report = info(soup);
  CHECK(report["components"] == 256);
  CHECK(report["boundary_edges"] == 768);
  CHECK(report["weld"]["closes_boundary_edges"] == 768);
  CHECK(report["weld"]["joins_vertices"] == 768 - 128);
  CHECK(report["weld"]["asked_for_by"] == "--weld exact");
  CHECK(contains(gsp_run({"info", soup}).out, "--weld exact"));
  for (const char* weld : {"exact", "0", "1e-6"}) {
    const json welded = info(soup, {"--weld", weld});
    CHECK(welded["components"] == 1);
    CHECK(welded["boundary_edges"] == 0);
    CHECK(welded["notes"].size() == 1);
  }
  const std::string map = folder.file("a.param.ply");
  const Ran made = gsp_run({"parameterize", soup, "-o", map, "--weld", "exact", "--base-vertices", "12", "--check"});
  CHECK(made.status == 0);
  CHECK(contains(made.err, "640 vertices were joined"));
  const Ran distance = gsp_run({"distance", soup, map, "--weld", "exact", "--samples", "1000", "--json"});
  CHECK(distance.status == 0);
  for (const char* command : {"curve", "encode", "picture", "info", "parameterize", "distance"})
    CHECK(contains(gsp_run({command, "--help"}).out, "--weld"));
  for (const char* weld : {"-1", "0.5", "nan", "near"}) CHECK(gsp_run({"info", soup, "--weld", weld}).status == 2);
}

TEST_CASE("surfaces that are no manifolds are refused, and cut apart on request through the whole chain") {
  const TemporaryFolder folder;
  // Two boxes that share an edge, and a wall on one of them: closed parts and an open one.
  Mesh mesh = weld(shapes::twice(shapes::box(3), {1, 1, 0}), 0.0).mesh;
  const int closed = mesh.vertex_count();
  mesh.positions.push_back({0.5, 0.5, 2});
  const int corner = mesh.faces[0][0], next = mesh.faces[0][1];
  mesh.faces.push_back({corner, next, closed});
  const std::string surface = folder.file("parts.ply");
  write_mesh(surface, mesh);
  const json report = info(surface);
  CHECK(report["usable"] == false);
  CHECK(report["repair"]["cut_edges"] == 8 + 1);
  CHECK(report["repair"]["usable_then"] == true);
  CHECK(report["repair"]["asked_for_by"] == "--repair cut");
  CHECK(contains(gsp_run({"info", surface}).out, "--repair cut"));
  const json cut = info(surface, {"--repair", "cut"});
  CHECK(cut["usable"] == true);
  CHECK(cut["components"] == 3);
  CHECK(cut["boundary_edges"] == 3);
  CHECK(cut["repair"]["cut_edges"] == 9);
  CHECK(cut["repair"]["cut_vertices"] == report["repair"]["cut_vertices"]);
  CHECK(cut["repair"]["added_vertices"] == 9 + 2);
  CHECK(cut["notes"].size() == 1);

  const std::string map = folder.file("a.param.ply"), remeshed = folder.file("a.sr.ply"), stream = folder.file("a.pgc"),
                    decoded = folder.file("b.sr.ply");
  CHECK(gsp_run({"parameterize", surface, "-o", map, "--base-vertices", "30"}).status == 3);
  const std::vector<std::string> parameterize = {"parameterize", surface,           "-o", map,       "--repair",
                                                 "cut",          "--base-vertices", "30", "--check", "--json"};
  const Ran made = gsp_run(parameterize);
  REQUIRE(made.status == 0);
  CHECK(json::parse(made.out)["edges_cut_apart"] == 9);
  CHECK(contains(made.err, "9 edges and"));
  REQUIRE(gsp_run({"remesh", map, "-o", remeshed, "--level", "3"}).status == 0);
  REQUIRE(gsp_run({"encode", remeshed, "-o", stream}).status == 0);
  REQUIRE(gsp_run({"decode", stream, "-o", decoded}).status == 0);
  CHECK(info(decoded)["components"] == 3);
  CHECK(info(decoded)["boundary_loops"] == 1);
  const Ran distance = gsp_run({"distance", surface, decoded, "--repair", "cut", "--samples", "20000", "--json"});
  REQUIRE(distance.status == 0);
  CHECK(json::parse(distance.out)["psnr_db"] > 50.0);
  for (const char* command : {"curve", "encode", "picture", "info", "parameterize", "distance"})
    CHECK(contains(gsp_run({command, "--help"}).out, "--repair"));
  CHECK(gsp_run({"info", surface, "--repair", "glue"}).status == 2);

  // A manifold stays the same bytes.
  write_mesh(folder.file("torus.ply"), shapes::torus(16, 8));
  std::vector<std::string> maps;
  for (const char* repair : {"none", "cut"}) {
    REQUIRE(gsp_run({"parameterize", folder.file("torus.ply"), "-o", map, "--repair", repair, "--base-vertices", "12"})
                .status == 0);
    maps.push_back(read_file(map));
  }
  CHECK(maps[0] == maps[1]);
}

TEST_CASE("faults: corners that were rounded are named with the weld that joins them") {
  const std::string root = shared_meshes();
  if (root.empty()) return;
  const json stl = info(root + "/faults/stl_jitter1e-7.stl");
  CHECK(stl["boundary_edges"] == 1728);
  CHECK(stl["weld"]["closes_boundary_edges"] == 1728);
  CHECK(stl["weld"]["asked_for_by"] == "--weld 1e-6");
  const json player = info(root + "/variety/basketball_player_20692.obj");
  CHECK(player["weld"]["joins_vertices"] == 938);
  CHECK(player["weld"]["asked_for_by"] == "--weld exact");
}

TEST_CASE("what a reader leaves out is said by info, and by what works on the surface") {
  const TemporaryFolder folder;
  const std::string path = write(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 3\nhello\n");
  CHECK(info(path)["notes"].size() == 2);
  const Ran distance = gsp_run({"distance", path, path, "--samples", "1000"});
  CHECK(distance.status == 0);
  CHECK(contains(distance.err, "unknown keyword"));
  const Ran curve = gsp_run({"curve", path, "-o", folder.file("out"), "--no-anchors", "--budgets", "100"});
  CHECK(contains(curve.err, "unknown keyword"));
}

TEST_CASE("places in refusals are the file's in every command") {
  const TemporaryFolder folder;
  const std::string path = write(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nf 2 5 5\n");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", path}, {"parameterize", path, "-o", folder.file("a.param.ply")}}) {
    const Ran ran = gsp_run(arguments);
    CHECK(ran.status == 3);
    CHECK(contains(ran.out + ran.err, "(face 2)"));
  }
  const std::string nan = write(folder, "b.obj", "v 0 0 0\nv 1 0 nan\nv 1 1 0\nf 1 2 3\n");
  CHECK(contains(gsp_run({"distance", nan, nan}).err, "b.obj: a coordinate is not a finite number"));
  CHECK(contains(gsp_run({"distance", nan, nan}).err, "(vertex 2)"));
}

TEST_CASE("surfaces of any size go through the whole chain, or are refused with the reason, at once") {
  const TemporaryFolder folder;
  const std::string surface = folder.file("a.off"), map = folder.file("a.param.ply"), remesh = folder.file("a.sr.ply"),
                    stream = folder.file("a.pgc"), decoded = folder.file("b.ply");
  double psnr = 0.0;
  for (const int exponent : {0, -190, 240, -1060, -660, -500, -330, -250, 260, 500, 1000}) {
    INFO(exponent);
    Mesh mesh = shapes::torus(12, 8);
    for (Vec3& p : mesh.positions) p = p.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
    write_mesh(surface, mesh);
    const Ran made = gsp_process("parameterize " + surface + " -o " + map + " --base-vertices 8 --check", folder);
    const bool in_range = exponent > -200 && exponent < 248;
    REQUIRE(made.status == (in_range ? 0 : 3));
    if (!in_range) {
      CHECK((contains(made.err, "too small") || contains(made.err, "too large")));
      CHECK(gsp_process("distance " + surface + " " + surface, folder).status == 3);
      CHECK(info(surface)["usable"] == false);
      continue;
    }
    CHECK(gsp_process("remesh " + map + " -o " + remesh + " --level 2", folder).status == 0);
    CHECK(gsp_process("encode " + remesh + " -o " + stream, folder).status == 0);
    CHECK(gsp_process("decode " + stream + " -o " + decoded, folder).status == 0);
    const Ran distance = gsp_process("distance " + surface + " " + decoded + " --samples 1000 --json", folder);
    REQUIRE(distance.status == 0);
    const double db = json::parse(distance.out)["psnr_db"];
    if (exponent == 0) psnr = db;
    CHECK(db == psnr);  // the same bits: powers of two scale out of all that is computed
  }
  // A remesh and a map that were made elsewhere are held to the same range.
  Mesh tiny = shapes::sphere(2);
  for (Vec3& p : tiny.positions) p *= 1e-200;
  write_mesh(surface, tiny);
  CHECK(gsp_process("encode " + surface + " -o " + stream, folder).status == 3);
}

TEST_CASE("a component without area is refused at once, in little memory") {
  const TemporaryFolder folder;
  std::string off = "OFF\n6 3 0\n";
  for (int i = 0; i < 6; ++i) off += std::to_string(i) + " 0 0\n";
  const std::string path = write(folder, "a.off", off + "3 0 1 2\n3 2 1 3\n3 2 3 4\n");
  const Ran made =
      gsp_process("parameterize " + path + " -o " + folder.file("a.param.ply"), folder, address_space(1000000));
  CHECK(made.status == 3);
  CHECK(contains(made.err, "no area"));
  CHECK(info(path)["refusal"]["cause"] == "no-area");
}

TEST_CASE("faces without area within a sound component cost nothing") {
  const TemporaryFolder folder;
  // Every other edge of a sphere's faces gets a vertex on one side only; the gap is a face without area.
  Mesh mesh = shapes::sphere(3);
  const int faces = mesh.face_count();
  for (int f = 0; f < faces; f += 2) {
    const Triangle t = mesh.faces[f];
    const int middle = mesh.vertex_count();
    mesh.positions.push_back(mesh.positions[t[0]]);  // at a corner: an edge of no length and two faces without area
    mesh.faces[f] = {middle, t[1], t[2]};
    mesh.faces.push_back({t[0], t[1], middle});
    mesh.faces.push_back({t[0], middle, t[2]});
  }
  const std::string path = folder.file("a.off"), map = folder.file("a.param.ply");
  write_mesh(path, mesh);
  CHECK(info(path)["zero_area_faces"] == faces);
  const Ran made = gsp_process("parameterize " + path + " -o " + map + " --base-vertices 12 --check --json", folder,
                               address_space(2000000));
  CHECK(made.status == 0);
  CHECK(json::parse(made.out)["vertices_added"] < mesh.face_count());
}

TEST_CASE("where memory is short for the solver that is said at once") {
  const TemporaryFolder folder;
  const std::string path = folder.file("torus.off"), map = folder.file("a.param.ply");
  write_mesh(path, shapes::torus(16, 8));
  // Whatever is too little ends with a sentence; what is enough, with a map.
  for (const int kib : {100000, 150000, 200000, 250000, 300000, 400000, 500000, 600000, 1000000}) {
    INFO(kib);
    const Ran made =
        gsp_process("parameterize " + path + " -o " + map + " --base-vertices 8 --quiet", folder, address_space(kib));
    CHECK((made.status == 0 || (made.status == 1 && contains(made.err, "not enough memory"))));
    if (kib >= 1000000) CHECK(made.status == 0);
  }
}

TEST_CASE("commands that solve nothing do with little address space") {
  const TemporaryFolder folder;
  const std::string path = folder.file("torus.off");
  write_mesh(path, shapes::torus(16, 8));
  for (const std::string& arguments :
       {std::string("--version"), std::string("--help"), "info " + path, std::string("parameterize --help"),
        "distance " + path + " " + path + " --samples 1000"}) {
    INFO(arguments);
    CHECK(gsp_process(arguments, folder, address_space(200000)).status == 0);
  }
}

TEST_CASE("a map that needs more than the memory limit is refused before the work, and any command gives up above it") {
  const TemporaryFolder folder;
  const std::string path = folder.file("torus.off"), map = folder.file("a.param.ply");
  write_mesh(path, shapes::torus(16, 8));
  const auto made = [&](const std::string& limit) {
    return gsp_run({"parameterize", path, "-o", map, "--base-vertices", "20", "--memory-limit", limit});
  };
  const Ran refused = made("60");
  CHECK(refused.status == 1);
  CHECK(contains(refused.err, "the map of 256 faces needs about 70 MB of memory, more than --memory-limit 60"));
  CHECK_FALSE(std::filesystem::exists(map));
  CHECK(made("100000").status == 0);
  const Ran given_up = gsp_run({"distance", path, path, "--samples", "1000", "--memory-limit", "1"});
  CHECK(given_up.status == 1);
  CHECK(contains(given_up.err, "MB of memory are taken, more than --memory-limit 1, during "));
}

TEST_CASE("features of a file become creases, and a file that names what is not there is refused with its line") {
  const TemporaryFolder folder;
  const Mesh box = shapes::box(3);
  const std::string surface = folder.file("box.ply"), features = folder.file("box.sharp"),
                    map = folder.file("a.param.ply");
  write_mesh(surface, box);
  const auto made = [&](const std::string& text) {
    std::ofstream(features, std::ios::binary) << text;
    return gsp_run({"parameterize", surface, "-o", map, "--features-file", features, "--base-vertices", "40", "--json",
                    "--check"});
  };
  // All twelve edges of the box, in both forms.
  std::string sharp, pairs;
  const FeatureEdges edges = edges_sharper_than(box, 80.0);
  for (int f = 0; f < box.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = box.faces[f][k], b = box.faces[f][(k + 1) % 3];
      if (std::binary_search(edges.begin(), edges.end(), ascending(a, b)) && a < b) {
        sharp += "1," + std::to_string(f) + "," + std::to_string(k) + "\n";
        pairs += std::to_string(a) + " " + std::to_string(b) + "\n";
      }
    }
  for (const std::string& text : {std::to_string(edges.size()) + "\n" + sharp, pairs}) {
    const Ran ran = made(text);
    REQUIRE(ran.status == 0);
    const json report = json::parse(ran.out);
    CHECK(report["feature_edges"] == edges.size());
    CHECK(report["feature_curves"] == 12);
    CHECK(report["creases"] >= 12);
  }
  CHECK(json::parse(made("").out)["creases"] == 0);
  const auto refused = [&](const std::string& text, int line) {
    const Ran ran = made(text);
    CHECK(ran.status == 3);
    const json error = json::parse(ran.out)["error"];
    CHECK(contains(error["message"].get<std::string>(), features));
    CHECK(error["index"] == line);
    CHECK(error["element"] == "line");
  };
  refused("1\n1,99999,0\n", 2);
  refused("1\n1,0,3\n", 2);
  refused(pairs.substr(0, pairs.find('\n')) + "\n\n0 99999\n", 3);
  refused("5\n1,0,0\n", 1);
  refused("0 1 2 3\n", 1);
}
