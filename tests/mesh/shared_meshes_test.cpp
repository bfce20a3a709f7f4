#include <catch2/catch.hpp>
#include <cctype>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "mesh/io.h"
#include "mesh/topology.h"
#include "test_meshes.h"

using namespace gsp;

namespace {

/// One row of MESHES.tsv, which another program made from the same files.
struct Row {
  std::string path, vertices, triangles, components, loops, genus, manifold, defects;

  bool in(const std::string& folder) const { return path.rfind(folder + "/", 0) == 0; }
  bool has(const std::string& defect) const { return (manifold + defects).find(defect) != std::string::npos; }
  /// Whether there are polygons of five corners and more. The other program takes them for fans.
  bool has_large_polygons() const {
    std::size_t at = defects.find("polygons ");
    if (at == std::string::npos) return false;
    for (at += std::string("polygons ").size();; ++at) {
      if (std::stoi(defects.substr(at)) > 4) return true;
      at = defects.find(';', at);
      if (at == std::string::npos || at + 1 >= defects.size() || !std::isdigit(defects[at + 1])) return false;
    }
  }
  /// The number before the words, 0 where they are missing.
  int number_of(const std::string& words) const {
    const std::string text = " " + manifold + " " + defects;
    const std::size_t at = text.find(" " + words);
    if (at == std::string::npos) return 0;
    const std::size_t start = text.find_last_of(" ;", at - 1) + 1;
    return std::stoi(text.substr(start, at - start));
  }
};

std::vector<Row> rows(const std::string& folder) {
  const std::string root = shared_meshes();
  std::vector<Row> rows;
  if (root.empty()) return rows;
  std::ifstream in(root + "/MESHES.tsv");
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    Row row;
    for (std::string* field : {&row.path, &row.vertices, &row.triangles, &row.components, &row.loops, &row.genus,
                               &row.manifold, &row.defects})
      std::getline(fields, *field, '\t');
    if (row.in(folder)) rows.push_back(row);
  }
  CHECK_FALSE(rows.empty());
  return rows;
}

void check_counts(const Row& row, const TopologyReport& report) {
  CHECK(std::to_string(report.vertices) == row.vertices);
  CHECK(std::to_string(report.faces) == row.triangles);
  CHECK(static_cast<int>(report.isolated_vertices.size()) == row.number_of("isolated verts"));
  CHECK(report.duplicate_positions == row.number_of("duplicate position"));
  CHECK(static_cast<int>(report.zero_area_faces.size()) == row.number_of("zero-area faces"));
  CHECK(static_cast<int>(report.duplicate_faces.size()) == row.number_of("duplicate faces"));
  CHECK(static_cast<int>(report.repeated_index_faces.size()) == row.number_of("repeated-index faces"));
  CHECK(static_cast<int>(report.non_finite_vertices.size()) == row.number_of("non-finite verts"));
  CHECK(static_cast<int>(report.non_manifold_edges.size()) == row.number_of("nm edges"));
  CHECK(static_cast<int>(report.non_manifold_vertices.size()) == row.number_of("nm verts"));
  CHECK(static_cast<int>(report.misoriented_edges.size()) == row.number_of("misoriented edges"));
  if (row.manifold != "yes") return;  // what a component or a loop is, is then a matter of taste
  CHECK(std::to_string(report.components.size()) == row.components);
  CHECK(std::to_string(report.boundary_loops) == row.loops);
}

void check_good(const std::string& folder) {
  for (const Row& row : rows(folder)) {
    INFO(row.path);
    const TopologyReport report = topology_report(read_mesh(shared_meshes() + "/" + row.path));
    check_counts(row, report);
    CHECK(report.usable());
    // Several of the same genus stand as "0 x16".
    for (const ComponentReport& component : report.components)
      CHECK(std::to_string(component.genus.value()) == row.genus.substr(0, row.genus.find(" x")));
  }
}

}  // namespace

TEST_CASE("good meshes have the counts and the genus that another program found") {
  check_good("variety");
  check_good("paper");
  check_good("semiregular");
}

TEST_CASE("large meshes have the counts and the genus that another program found", "[slow]") { check_good("large"); }

TEST_CASE("every bad mesh gives a report with the defects another program found, or a named error") {
  for (const Row& row : rows("bad")) {
    INFO(row.path);
    try {
      const TopologyReport report = topology_report(read_mesh(shared_meshes() + "/" + row.path));
      CHECK_FALSE(row.vertices.empty());
      if (row.has_large_polygons()) {
        CHECK(std::to_string(report.vertices) == row.vertices);
        CHECK(std::to_string(report.faces) == row.triangles);
        continue;
      }
      check_counts(row, report);
      const bool usable = row.manifold == "yes" && !row.has("repeated-index") && !row.has("non-finite");
      CHECK(report.usable() == usable);
      if (report.refusal) CHECK(exit_status(report.refusal->cause()) == 3);
    } catch (const Error& error) {
      INFO(error.what());
      CHECK((row.vertices.empty() || row.has("out-of-range") || error.cause() == Cause::PolygonNotSimple));
      if (error.cause() == Cause::PolygonNotSimple) CHECK(row.has_large_polygons());
      if (row.has("out-of-range")) CHECK(error.cause() == Cause::IndexOutOfRange);
      CHECK(exit_status(error.cause()) == 3);
    }
  }
}

TEST_CASE("damage done on purpose is named") {
  const std::string root = shared_meshes();
  if (root.empty()) return;
  const std::vector<std::pair<std::string, Cause>> damage = {
      {"assimp_invalid_OutOfMemory.off", Cause::Truncated},
      {"assimp_invalid_empty.ply", Cause::Truncated},
      {"bad_degenerate_face.off", Cause::DegenerateFace},
      {"bad_duplicate_face.off", Cause::DuplicateFace},
      {"bad_header_count_too_big.off", Cause::Truncated},
      {"bad_index_out_of_range.off", Cause::IndexOutOfRange},
      {"bad_inf_vertex.off", Cause::NonFinite},
      {"bad_klein.off", Cause::InconsistentOrientation},
      {"bad_moebius.off", Cause::InconsistentOrientation},
      {"bad_nan_vertex.ply", Cause::NonFinite},
      {"bad_negative_index.off", Cause::IndexOutOfRange},
      {"bad_truncated_ascii.off", Cause::Truncated},
      {"bad_truncated_binary.ply", Cause::Truncated},
      {"bad_two_touching_tets.off", Cause::NonManifoldVertex},
      {"cgal_b9.ply", Cause::NoFaces},
      {"vhacd_squirrel.off", Cause::NonManifoldEdge},
      {"cgal_oblong-shuffled.off", Cause::InconsistentOrientation}};
  for (const auto& [name, cause] : damage) {
    INFO(name);
    try {
      require_parameterizable(read_mesh(root + "/bad/" + name));
      FAIL_CHECK("no error");
    } catch (const Error& error) {
      CHECK(error.cause() == cause);
    }
  }
}
