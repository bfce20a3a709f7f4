#include "param/parameterize.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/check_report.h"
#include "cli/input.h"
#include "cli/options.h"
#include "cli/print.h"
#include "experiments/base/base_by_rate.h"
#include "experiments/cells/cell_options.h"
#include "experiments/plot/gnuplot.h"
#include "experiments/report/cost.h"
#include "mesh/features/feature_file.h"
#include "mesh/memory.h"
#include "param/map/param_file.h"

namespace gsp::cli {

namespace {

struct ParameterizeArguments {
  std::string mesh, output, features, omega_csv, omega_plot;
  std::string method = "gsp";
  ReadOptions read;
  ParameterizeOptions parameterize = preset_options("default");
  bool check = false, profile = false;
};

/// Draws the cost of the removals to FOLDER/NAME.png, .svg and .gp for the path FOLDER/NAME, whatever ending it has.
void draw_cost(const std::string& path, const std::string& mesh, const CostCurve& cost) {
  const std::filesystem::path place(path);
  const std::string name = place.stem().string(), folder = place.parent_path().string();
  draw_figure(folder.empty() ? "." : folder, name,
              cost_script(name, std::filesystem::path(mesh).stem().string(), cost));
}

/// Where the stages of the simplification's cost begin, in vertices that remain; null where they were not reached.
Json stages(const CostCurve& cost) {
  const auto value = [](const std::optional<double>& at) { return at ? Json(std::lround(*at)) : Json(nullptr); };
  return {{"second", value(cost.second_stage)}, {"third", value(cost.third_stage)}};
}

/// Says before the work what cannot end well. Throws Error(OutOfMemory) above --memory-limit; where only the machine
/// has too little it is a note, since the estimate may be wrong.
void expect_memory(const Mesh& mesh, const Context& context, Progress& progress) {
  constexpr double kMegabyte = 1e6;
  const double bytes = parameterize_memory(mesh);
  const std::string need =
      fmt::format("the map of {} faces needs about {:.0f} MB of memory", mesh.face_count(), bytes / kMegabyte);
  const int limit = context.console.memory_limit;
  if (limit > 0 && bytes > kMegabyte * limit)
    throw Error(Cause::OutOfMemory, fmt::format("{}, more than --memory-limit {}", need, limit));
  if (const double there = available_memory(); bytes > there)
    progress.note(fmt::format("{}, and the machine has {:.0f} MB left", need, there / kMegabyte));
}

int run_parameterize(ParameterizeArguments& options, Context& context) {
  Progress progress = context.console.progress();
  Profile profile;
  if (options.profile) progress.set_profile(&profile);
  auto whole = progress.step("whole");
  options.parameterize.method = method_of(options.method);
  const SurfaceFile file = [&] {
    const auto step = progress.step("read");
    return read_input(options.mesh, options.read, context);
  }();
  expect_memory(file.mesh, context, progress);
  if (!options.features.empty())
    options.parameterize.features = in_places_of(file, [&] { return read_features(options.features, file.mesh); });
  const ParameterizeResult result = in_places_of(file, [&] {
    return parameterize(file.mesh, with_base_by_rate(file.mesh, options.parameterize, progress), progress);
  });
  {
    const auto step = progress.step("write");
    write_parameterization(options.output, result.map);
  }
  whole.end();
  if (!options.omega_csv.empty()) write_omega_csv(options.omega_csv, result.omega);
  const CostCurve cost = cost_curve(result.omega);
  if (!options.omega_plot.empty() && !cost.bins.empty()) draw_cost(options.omega_plot, options.mesh, cost);

  Json report = {{"method", options.method},
                 {"objective", objective_name(options.parameterize.objective)},
                 {"weights", weights_name(options.parameterize.weights)},
                 {"corners", corners_name(options.parameterize.corners)},
                 {"base_edges", base_edges_name(options.parameterize.base_edges)},
                 {"priority", priority_name(options.parameterize.priority)},
                 {"tries", options.parameterize.tries},
                 {"replicate", options.parameterize.replicate},
                 {"base_vertices", result.map.base.vertex_count()},
                 {"base_faces", result.map.base.face_count()},
                 {"feature_edges", result.features.edges.size()},
                 {"feature_curves", result.features.curves},
                 {"feature_curves_given_way", result.features.given_way},
                 {"creases", result.map.base.creases.size()},
                 {"relaxation_rounds", result.relaxation_rounds},
                 {"corners_moved", result.corners_moved},
                 {"base_edges_flipped", result.base_edges_flipped},
                 {"flips_before_repair", result.flips_before_repair},
                 {"vertices_added", result.map.surface.vertex_count() - file.mesh.vertex_count()},
                 {"edges_cut_apart", file.cuts ? file.cuts->edges : 0},
                 {"vertices_cut_apart", file.cuts ? file.cuts->vertices : 0},
                 {"vertices_held", result.held_vertices},
                 {"cost_stages_begin", stages(cost)},
                 {"output", options.output}};
  int status = 0;
  if (options.check) {
    const MapCheck check = check_map(result.map);
    report["check"] = check_report(check);
    status = check.valid() ? 0 : exit_status(Cause::InvalidMap);
  }
  if (options.profile)
    print_report(context, report, profile.steps());
  else
    print_report(context, report);
  return status;
}

}  // namespace

void add_parameterize(CLI::App& app, Context& context) {
  Command command(app, context, "parameterize", "a globally smooth map of a surface onto a base complex");
  auto options = std::make_shared<ParameterizeArguments>();
  command.argument("MESH", options->mesh, "surface: PLY, OBJ, OFF or STL");
  command.output("MAP", options->output, Content::Ply, "the map, *.param.ply");
  command.read_options(options->read);
  command.choice("--method", options->method, map_method_words(),
                 "the paper's map, or a baseline on the same base vertices");
  command.parameterize_options(options->parameterize);
  command.optional_input("--features-file", options->features,
                         "feature edges to take instead of those found: quad remeshers' *.sharp (a count, then rows of "
                         "type,face,edge), or rows of two vertices");
  command.replicate_option(options->parameterize);
  command.optional_output("--omega-csv", options->omega_csv, Content::Csv,
                          "also write the cost of every vertex removal (figure 5d)");
  command.optional_output(
      "--omega-plot", options->omega_plot, Content::Figure,
      "also draw that cost with its three stages and the automatic stop: FILE's name with .png, .svg and .gp");
  command.flag(
      "--profile", options->profile,
      "also print wall and CPU seconds and peak memory of each step; its record of the peak begins anew with each "
      "step, so that of others (/usr/bin/time) is then the last step's");
  command.flag("--check", options->check, "check the map face by face; exit status 1 where it is not valid");
  command.on_run([options, &context] { return run_parameterize(*options, context); });
}

}  // namespace gsp::cli
