#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/report.h"
#include "mesh/io.h"
#include "metrics/surface_distance.h"

namespace gsp::cli {

namespace {

struct Options {
  std::string a, b;
  DistanceOptions distance;
};

Json direction(const OneWayDistance& d) {
  return {{"mean", d.mean}, {"rms", d.rms}, {"rms_standard_error", d.rms_standard_error}, {"quantile95", d.quantile95},
          {"hausdorff", d.hausdorff}, {"samples", d.samples}};
}

int run_distance(const Options& options, Context& context) {
  Progress progress = context.console.progress();
  const Mesh a = read_mesh(options.a), b = read_mesh(options.b);
  const SurfaceDistance d = surface_distance(a, b, options.distance, progress);
  print_report(context, {{"forward", direction(d.forward)},
                         {"backward", direction(d.backward)},
                         {"mean", d.mean()},
                         {"rms", d.rms()},
                         {"quantile95", d.quantile95()},
                         {"hausdorff", d.hausdorff()},
                         {"diagonal", d.diagonal},
                         {"psnr_db", d.psnr_db()},
                         {"psnr_formula", "20 log10(diagonal of the first / larger RMS)"},
                         {"standard_error_db", d.standard_error_db()},
                         {"samples", options.distance.samples},
                         {"seed", options.distance.seed}});
  return 0;
}

}  // namespace

void add_distance(CLI::App& app, Context& context) {
  Command command(app, context, "distance", "how far two surfaces are apart, both ways");
  auto options = std::make_shared<Options>();
  command.argument("A", options->a, "reference surface; distances are in its units");
  command.argument("B", options->b, "the other surface");
  command.sampling_options(options->distance.samples, options->distance.seed);
  command.on_run([options, &context] { return run_distance(*options, context); });
}

}  // namespace gsp::cli
