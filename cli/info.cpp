#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/print.h"
#include "mesh/io.h"
#include "mesh/topology.h"
#include "remesh/filters/normal_share.h"
#include "remesh/semiregular_file.h"

namespace gsp::cli {

namespace {

Json component_report(const ComponentReport& component) {
  return {{"vertices", component.vertices},
          {"edges", component.edges},
          {"faces", component.faces},
          {"boundary_loops", component.boundary_loops},
          {"genus", component.genus ? Json(*component.genus) : Json()},
          {"first_face", component.first_face}};
}

Json topology(const Mesh& mesh, const TopologyReport& report) {
  Json components = Json::array();
  for (const ComponentReport& component : report.components) components.push_back(component_report(component));
  return {{"vertices", report.vertices},
          {"faces", report.faces},
          {"boundary_loops", report.boundary_loops},
          {"diagonal", report.non_finite_vertices.empty() ? Json(bounding_box_diagonal(mesh)) : Json()},
          {"isolated_vertices", report.isolated_vertices.size()},
          {"duplicate_positions", report.duplicate_positions},
          {"zero_area_faces", report.zero_area_faces.size()},
          {"non_finite_vertices", report.non_finite_vertices.size()},
          {"repeated_index_faces", report.repeated_index_faces.size()},
          {"duplicate_faces", report.duplicate_faces.size()},
          {"non_manifold_edges", report.non_manifold_edges.size()},
          {"non_manifold_vertices", report.non_manifold_vertices.size()},
          {"misoriented_edges", report.misoriented_edges.size()},
          {"components", report.components.size()},
          {"component_list", components}};
}

// Of a remesh, how many of its vertices one number gives.
Json levels(const std::string& path) {
  const SemiregularMesh mesh = read_semiregular(path);
  const NormalShare share = normal_share(mesh);
  return {{"level", mesh.level},
          {"base_vertices", mesh.base_vertices},
          {"base_faces", mesh.base_faces.size()},
          {"vertices_above_base", share.vertices},
          {"normal_vertices", share.normal},
          {"normal_exceptions", share.exceptions},
          {"boundary_vertices", share.boundary},
          {"normal_percent", share.percent()}};
}

// A file that cannot be read is an answer here, not a failure to give one.
int info(const std::string& path, const Context& context) {
  Json report = {{"file", path}};
  std::optional<Error> refusal;
  try {
    const Mesh mesh = read_mesh(path);
    const TopologyReport found = topology_report(mesh);
    report.update(topology(mesh, found));
    refusal = found.refusal;
    if (path.ends_with(".sr.ply")) report.update(levels(path));
  } catch (const Error& error) {
    if (exit_status(error.cause()) != exit_status(Cause::CannotOpen)) throw;
    refusal = error;
  }
  report["usable"] = !refusal.has_value();
  if (refusal) report["refusal"] = error_report(*refusal);
  print_report(context, report);
  return refusal ? exit_status(refusal->cause()) : 0;
}

}  // namespace

void add_info(CLI::App& app, Context& context) {
  Command command(app, context, "info", "what a surface is, and why it cannot be used");
  auto path = std::make_shared<std::string>();
  command.argument("MESH", *path, "surface: PLY, OBJ, OFF or STL");
  command.on_run([path, &context] { return info(*path, context); });
}

}  // namespace gsp::cli
