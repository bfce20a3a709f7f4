#include "param/parameterize.h"

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/check_report.h"
#include "cli/options.h"
#include "cli/print.h"
#include "experiments/cell_options.h"
#include "mesh/io.h"
#include "param/param_file.h"

namespace gsp::cli {

namespace {

struct ParameterizeArguments {
  std::string mesh, output, omega_csv;
  std::string method = "gsp";
  ParameterizeOptions parameterize;
  bool check = false;
};

int run_parameterize(ParameterizeArguments& options, Context& context) {
  Progress progress = context.console.progress();
  options.parameterize.method = method_of(options.method);
  const Mesh mesh = read_mesh(options.mesh);
  const ParameterizeResult result = parameterize(mesh, options.parameterize, progress);
  write_parameterization(options.output, result.map);
  if (!options.omega_csv.empty()) write_omega_csv(options.omega_csv, result.omega);

  Json report = {{"method", options.method},
                 {"objective", objective_name(options.parameterize.objective)},
                 {"weights", weights_name(options.parameterize.weights)},
                 {"base_vertices", result.map.base.vertex_count()},
                 {"base_faces", result.map.base.face_count()},
                 {"relaxation_rounds", result.relaxation_rounds},
                 {"corners_moved", result.corners_moved},
                 {"flips_before_repair", result.flips_before_repair},
                 {"vertices_added", result.map.surface.vertex_count() - mesh.vertex_count()},
                 {"vertices_held", result.held_vertices},
                 {"output", options.output}};
  int status = 0;
  if (options.check) {
    const MapCheck check = check_map(result.map);
    report["check"] = check_report(check);
    status = check.valid() ? 0 : exit_status(Cause::InvalidMap);
  }
  print_report(context, report);
  return status;
}

}  // namespace

void add_parameterize(CLI::App& app, Context& context) {
  Command command(app, context, "parameterize", "a globally smooth map of a surface onto a base complex");
  auto options = std::make_shared<ParameterizeArguments>();
  command.argument("MESH", options->mesh, "surface: PLY, OBJ, OFF or STL");
  command.output("MAP", options->output, "the map, *.param.ply");
  command.choice("--method", options->method, map_method_words(), "the paper's map, or a baseline on the same base");
  command.parameterize_options(options->parameterize);
  command.optional_file("--omega-csv", options->omega_csv, "also write the cost of every vertex removal (figure 5d)");
  command.flag("--check", options->check, "check the map face by face; exit status 1 where it is not valid");
  command.on_run([options, &context] { return run_parameterize(*options, context); });
}

}  // namespace gsp::cli
