#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/print.h"
#include "mesh/cut_apart.h"
#include "mesh/io.h"
#include "mesh/topology.h"
#include "mesh/weld.h"
#include "remesh/filters/displacement.h"
#include "remesh/filters/normal_share.h"
#include "remesh/remesh_options.h"
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
          {"boundary_edges", report.boundary_edges},
          {"diagonal", report.non_finite_vertices.empty() ? Json(bounding_box_diagonal(mesh)) : Json()},
          {"isolated_vertices", report.isolated_vertices.size()},
          {"duplicate_positions", report.duplicate_positions},
          {"zero_area_faces", report.zero_area_faces.size()},
          {"non_finite_vertices", report.non_finite_vertices.size()},
          {"out_of_range_faces", report.out_of_range_faces.size()},
          {"repeated_index_faces", report.repeated_index_faces.size()},
          {"duplicate_faces", report.duplicate_faces.size()},
          {"non_manifold_edges", report.non_manifold_edges.size()},
          {"non_manifold_vertices", report.non_manifold_vertices.size()},
          {"misoriented_edges", report.misoriented_edges.size()},
          {"components", report.components.size()},
          {"component_list", components}};
}

/// What `--weld` would do to the boundary, exactly or within what corners differ by that were rounded to single
/// precision.
Json weld_report(const Mesh& mesh, int boundary_edges) {
  constexpr double kRounded = 1e-6;
  const auto effect = [&](double share) {
    const WeldedMesh welded = weld(mesh, share);
    return std::pair(mesh.vertex_count() - welded.mesh.vertex_count(),
                     boundary_edges - topology_report(welded.mesh).boundary_edges);
  };
  const auto exact = effect(0.0), rounded = effect(kRounded);
  const bool exact_is_enough = exact.second >= rounded.second;
  const auto [joined, closed] = exact_is_enough ? exact : rounded;
  return {{"joins_vertices", joined},
          {"closes_boundary_edges", closed},
          {"asked_for_by", closed > 0 ? Json(exact_is_enough ? "--weld exact" : "--weld 1e-6") : Json()}};
}

Json cuts_report(const CutCounts& cuts) {
  return {{"cut_edges", cuts.edges}, {"cut_vertices", cuts.vertices}, {"added_vertices", cuts.added_vertices}};
}

/// What `--repair cut` would do.
Json repair_report(const Mesh& mesh) {
  const CutApart cut = cut_apart(mesh);
  Json report = cuts_report(cut.counts);
  report["usable_then"] = topology_report(cut.surface.mesh).usable();
  report["asked_for_by"] = "--repair cut";
  return report;
}

/// Of a displaced mesh, its control mesh and how large its displacements are.
Json displaced_report(const SemiregularMesh& mesh) {
  const Displacements numbers = displaced_form(mesh).displacements;
  double sum = 0.0, largest = 0.0;
  std::size_t across = 0;
  for (std::size_t v = 0; v < numbers.along.size(); ++v) {
    sum += numbers.along[v] * numbers.along[v];
    largest = std::max(largest, std::abs(numbers.along[v]));
    across += numbers.across[v] != 0.0;
  }
  return {{"control_points", mesh.control->points.size()},
          {"control_grid", mesh.control->grid},
          {"vertices_with_a_second_number", across},
          {"rms_displacement", std::sqrt(sum / static_cast<double>(numbers.along.size()))},
          {"largest_displacement", largest}};
}

/// Of a remesh, how many of its vertices one number gives.
Json levels(const std::string& path) {
  const SemiregularMesh mesh = read_semiregular(path);
  if (mesh.control)
    return {{"kind", remesh_kind_name(RemeshKind::Displaced)},
            {"level", mesh.level},
            {"base_vertices", mesh.base_vertices},
            {"base_faces", mesh.base_faces.size()},
            {"displaced", displaced_report(mesh)}};
  const NormalShare share = normal_share(mesh);
  return {{"level", mesh.level},
          {"base_vertices", mesh.base_vertices},
          {"base_faces", mesh.base_faces.size()},
          {"crease_edges", mesh.creases.size()},
          {"vertices_above_base", share.vertices},
          {"normal_vertices", share.normal},
          {"normal_exceptions", share.exceptions},
          {"boundary_vertices", share.boundary},
          {"crease_vertices", share.creased},
          {"normal_percent", share.percent()}};
}

// A file that cannot be read is an answer here, not a failure to give one.
int info(const std::string& path, const ReadOptions& options, const Context& context) {
  Json report = {{"file", path}};
  std::optional<Error> refusal;
  try {
    const SurfaceFile file = read_surface(path, options);
    const TopologyReport found = topology_report(file.mesh);
    report.update(topology(file.mesh, found));
    if (found.boundary_edges > 0) report["weld"] = weld_report(file.mesh, found.boundary_edges);
    const bool to_cut =
        !found.non_manifold_edges.empty() || !found.non_manifold_vertices.empty() || !found.misoriented_edges.empty();
    if (to_cut && found.out_of_range_faces.empty()) report["repair"] = repair_report(file.mesh);
    if (file.cuts) report["repair"] = cuts_report(*file.cuts);
    if (!file.notes.empty()) report["notes"] = file.notes;
    if (path.ends_with(".sr.ply")) report.update(levels(path));
    if (found.refusal) refusal = in_file(*found.refusal, file.numbering);
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
  auto options = std::make_shared<ReadOptions>();
  command.argument("MESH", *path, "surface: PLY, OBJ, OFF or STL");
  command.read_options(*options);
  command.on_run([path, options, &context] { return info(*path, *options, context); });
}

}  // namespace gsp::cli
