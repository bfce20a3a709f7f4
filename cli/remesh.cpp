#include "remesh/remesh.h"

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/print.h"
#include "experiments/base/level_by_rate.h"
#include "experiments/curve/targets.h"
#include "param/map/param_file.h"
#include "remesh/semiregular_file.h"

namespace gsp::cli {

namespace {

struct RemeshArguments {
  std::string map, output;
  RemeshOptions remesh;
  double max_error = 0.0;
};

int run_remesh(const RemeshArguments& options, Context& context) {
  Progress progress = context.console.progress();
  const Parameterization map = read_parameterization(options.map);
  const SemiregularMesh result = options.max_error > 0.0
                                     ? remesh_to_error(map, options.max_error, options.remesh, progress)
                                     : remesh_by_rate(map, options.remesh, progress);
  write_semiregular(options.output, result, provenance_of(options.remesh));
  print_report(context, {{"level", result.level},
                         {"kind", remesh_kind_name(options.remesh.kind)},
                         {"positions", positions_name(options.remesh.positions)},
                         {"vertices", result.positions.size()},
                         {"faces", result.base_faces.size() << (2 * result.level)},
                         {"base_vertices", result.base_vertices},
                         {"base_faces", result.base_faces.size()},
                         {"crease_edges", result.creases.size()},
                         {"output", options.output}});
  return 0;
}

}  // namespace

void add_remesh(CLI::App& app, Context& context) {
  Command command(app, context, "remesh", "a semi-regular mesh made through a map");
  auto options = std::make_shared<RemeshArguments>();
  command.argument("MAP", options->map, "map: *.param.ply");
  command.output("MESH", options->output, Content::Ply, "the mesh, *.sr.ply");
  command.remesh_options(options->remesh);
  command.kind_option(options->remesh);
  command.number(
      "--max-error", options->max_error, 0.0, 1.0,
      "instead of a level: the first whose RMS distance over the diagonal is at most X; 0 leaves it to --level");
  command.exclude("--max-error", "--level");
  command.on_run([options, &context] { return run_remesh(*options, context); });
}

}  // namespace gsp::cli
