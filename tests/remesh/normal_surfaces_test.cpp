#include "remesh/normal/normal_remesh.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>
#include <iostream>

#include "mesh/io.h"
#include "mesh/topology.h"
#include "param/map/base_fan.h"
#include "param/parameterize.h"
#include "remesh/normal/chart_index.h"
#include "tests/test_meshes.h"

using namespace gsp;

namespace {

/// Checks that the remesh's faces cover the domain once, upright, and that its vertices lie where the map has them.
void check_covers_domain(const Parameterization& map) {
  int level = 0;
  while (map.base.face_count() << (2 * level) < input_face_count(map)) ++level;
  const auto levels = subdivision_levels(map.base.vertex_count(), map.base.faces, level);
  const auto pieces = pieces_by_chart(map);
  Progress progress;
  const NormalRemesh remesh = normal_remesh(map, pieces, levels, {}, progress);
  double least = 1.0, sum = 0.0;
  for (int f = 0; f < levels.back().face_count(); ++f) {
    const auto z = remesh.domain.corners(f);
    const double area = chart_area(z[0], z[1], z[2]);
    least = std::min(least, area);
    sum += area;
  }
  CHECK(least > 0.0);
  CHECK(sum == Approx(map.base.face_count() * kChartArea).epsilon(1e-9));
  const ChartIndex index(map, pieces);
  const double diagonal = bounding_box_diagonal(map.surface);
  double farthest = 0.0;
  int outside = 0;
  for (std::size_t i = 0; i < remesh.domain.vertices().size(); ++i) {
    const DomainVertex& v = remesh.domain.vertices()[i];
    outside += !inside_chart(v.in_chart());
    const Vec3 there = position_at(map.surface, index.at(v.chart, v.in_chart()));
    farthest = std::max(farthest, (remesh.positions[map.base.vertex_count() + i] - there).norm());
  }
  CHECK(outside == 0);
  CHECK(farthest < 1e-7 * diagonal);
}

}  // namespace

TEST_CASE("no face of a normal remesh folds in the domain, on all small shared surfaces") {
  constexpr int kSmall = 4000;  // vertices
  const std::string shared = shared_meshes();
  if (shared.empty()) return;
  int surfaces = 0;
  for (const char* folder : {"/variety", "/semiregular"})
    for (const auto& file : std::filesystem::directory_iterator(shared + folder)) {
      const Mesh mesh = read_mesh(file.path().string());
      if (mesh.vertex_count() > kSmall || topology_report(mesh).refusal) continue;
      INFO(file.path().filename().string());
      Progress progress;
      check_covers_domain(parameterize(mesh, {}, progress).map);
      ++surfaces;
    }
  CHECK(surfaces > 10);
}

// Hidden, since it takes minutes: test_normal_surfaces "[closed]" names them one by one on standard error. Slow as
// well, since a filter that leaves out the slow ones alone takes hidden ones in.
TEST_CASE("no face of a normal remesh folds in the domain, on all closed shared surfaces", "[.][closed][slow]") {
  const std::string shared = shared_meshes();
  REQUIRE_FALSE(shared.empty());
  for (const char* folder : {"/paper", "/variety", "/semiregular"})
    for (const auto& file : std::filesystem::directory_iterator(shared + folder)) {
      const Mesh mesh = read_mesh(file.path().string());
      const TopologyReport report = topology_report(mesh);
      if (report.refusal || report.boundary_loops > 0) continue;
      INFO(file.path().filename().string());
      ParameterizeOptions options;
      if (mesh.vertex_count() > 1000) options.base_vertices = 200;
      Progress progress;
      const auto start = std::chrono::steady_clock::now();
      check_covers_domain(parameterize(mesh, options, progress).map);
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      std::cerr << file.path().filename().string() << ": " << seconds.count() << " s\n";
    }
}
