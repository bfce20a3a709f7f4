#include <catch2/catch.hpp>
#include <filesystem>

#include "mesh/io.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"
#include "param/parameterize.h"
#include "test_meshes.h"

using namespace gsp;

namespace {

constexpr Method kBaselines[] = {Method::Maps, Method::MapsSmoothed, Method::Hybrid};

ParameterizeOptions with_base(int base_vertices) {
  ParameterizeOptions options;
  options.base_vertices = base_vertices;
  return options;
}

void check_same(const Parameterization& a, const Parameterization& b) {
  CHECK(a.surface.positions == b.surface.positions);
  CHECK(a.surface.faces == b.surface.faces);
  CHECK(a.base.vertices == b.base.vertices);
  CHECK(a.base.faces == b.base.faces);
  CHECK(a.patch == b.patch);
  CHECK(a.position == b.position);
  CHECK(a.face_chart == b.face_chart);
  CHECK(a.face_corners == b.face_corners);
  CHECK(a.provenance == b.provenance);
}

}  // namespace

TEST_CASE("a baseline is the same map alone, beside the others and beside gsp") {
  struct {
    const char* name;
    Mesh mesh;
    int base_vertices;
  } const cases[] = {{"open grid", shapes::grid(40, 30, 0.1), 12},
                     {"bumpy sphere in levels", shapes::bumpy_sphere(4), 20},
                     {"torus", shapes::torus(40, 20), 16}};
  for (const auto& c : cases) {
    Progress progress;
    ParameterizeOptions options = with_base(c.base_vertices);
    const auto beside =
        parameterize_all(c.mesh, {Method::Gsp, Method::Maps, Method::MapsSmoothed, Method::Hybrid}, options, progress);
    for (std::size_t i = 0; i < std::size(kBaselines); ++i) {
      INFO(c.name << ", " << method_name(kBaselines[i]));
      options.method = kBaselines[i];
      check_same(parameterize(c.mesh, options, progress).map, beside[i + 1].map);
    }
  }
}

TEST_CASE(
    "the baselines' maps cover their base once, on every small surface at hand, and MAPS' and hybrid fold nothing",
    "[slow]") {
  const std::string folder = shared_meshes();
  std::vector<std::pair<std::string, Mesh>> surfaces{{"open grid", shapes::grid(40, 30, 0.1)},
                                                     {"bumpy sphere", shapes::bumpy_sphere(4)},
                                                     {"torus", shapes::torus(40, 20)},
                                                     {"genus 3", shapes::genus_slab(3, 2)}};
  constexpr int kSmall = 7000;  // vertices
  if (!folder.empty())
    for (const auto& file : std::filesystem::directory_iterator(folder + "/variety")) {
      Mesh mesh = read_mesh(file.path().string());
      if (mesh.vertex_count() <= kSmall) surfaces.emplace_back(file.path().filename().string(), std::move(mesh));
    }
  for (const auto& [name, mesh] : surfaces) {
    INFO(name);
    Progress progress;
    const auto made = parameterize_all(mesh, {std::begin(kBaselines), std::end(kBaselines)}, {}, progress);
    for (std::size_t i = 0; i < made.size(); ++i) {
      INFO(method_name(kBaselines[i]));
      const MapCheck check = check_map(made[i].map);
      if (kBaselines[i] == Method::MapsSmoothed) {
        CHECK(check.flipped_faces <= made[i].flips_before_repair);
        CHECK(check.flipped_faces * 50 <= mesh.face_count());
      } else {
        CHECK(check.flipped_faces == 0);
        CHECK(check.wrong_angle_vertices == 0);
      }
      CHECK(check.mismatched_edges == 0);
      CHECK(check.misplaced_vertices == 0);
      CHECK(check.area_error < 1e-9);
    }
  }
}
