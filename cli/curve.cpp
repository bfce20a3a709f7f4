#include "experiments/curve/curve.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "cli/options.h"
#include "cli/print.h"
#include "cli/summary_report.h"
#include "experiments/cells/cell_options.h"
#include "experiments/cells/models.h"
#include "experiments/curve_job.h"
#include "experiments/output/quoting.h"

namespace gsp::cli {

namespace {

CurveOptions curve_defaults() {
  CurveOptions options;
  options.parameterize = preset_options("default");
  return options;
}

struct CurveArguments {
  std::vector<std::string> meshes;
  std::string output;
  std::vector<std::string> methods = {"gsp", "maps-smoothed"};
  std::string wavelet = "loop";
  std::vector<std::string> kinds = {remesh_kind_name(RemeshKind::Parametric)};
  std::vector<std::string> modes = {stream_mode_name(StreamMode::Embedded)};
  bool no_anchors = false;
  ReadOptions read;
  CurveOptions curve = curve_defaults();
};

int run_curve(CurveArguments& options, Context& context) {
  Progress progress = context.console.progress();
  options.curve.methods.clear();
  for (const std::string& word : options.methods) options.curve.methods.push_back(method_of(word));
  options.curve.anchors = !options.no_anchors;
  options.curve.encode.wavelet = wavelet_of(options.wavelet);
  options.curve.kinds.clear();
  for (const std::string& word : options.kinds) options.curve.kinds.push_back(remesh_kind_of(word));
  options.curve.modes.clear();
  for (const std::string& word : options.modes) options.curve.modes.push_back(stream_mode_of(word));
  const CurveJobResult job =
      curve_job(surface_files(options.meshes), options.output, options.read, options.curve, progress);
  if (context.json) {
    print_report(context,
                 {{"models", summaries_report(job.models)}, {"means", means_report(job.models)}, {"files", job.files}});
  } else {
    print_summaries(context.out, job.models);
    context.out << "files\n";
    for (const std::string& file : job.files) context.out << "  " << printable(file) << '\n';
  }
  for (const CurveSummary& model : job.models)
    if (!model.failure.empty()) context.console.error("gsp: " + model.model + ": " + model.failure);
  return job.failed() ? 1 : 0;
}

}  // namespace

void add_curve(CLI::App& app, Context& context) {
  Command command(app, context, "curve", "the main job: rate-distortion curves of surfaces");
  auto options = std::make_shared<CurveArguments>();
  command.arguments("MESH", options->meshes, "surfaces, or folders of them: PLY, OBJ, OFF, STL");
  command.output_folder("-o,--output", options->output, true, "folder for curve.csv and the figures");
  command.choices("--methods", options->methods, map_method_words(),
                  "maps to compare on the base vertices of one simplification");
  command.read_options(options->read);
  command.parameterize_options(options->curve.parameterize);
  command.remesh_options(options->curve.remesh);
  command.choices("--kinds", options->kinds, axis("kind").words,
                  "how vertices above the base are given, each with curves of its own: see gsp remesh --kind");
  command.encode_options(options->wavelet, options->curve.encode);
  command.choices("--modes", options->modes, axis("mode").words,
                  "how each size is coded: the prefix of one embedded stream; fixed, a stream for that size alone");
  command.sizes("--budgets", options->curve.budgets, "bytes to decode [256, 512, 1024, ... and the whole stream]");
  command.sampling_options(options->curve.samples, options->curve.seed);
  command.integer("--replicates", options->curve.replicates, 1, kMostReplicates,
                  "how often each map is made with other chance, for the intervals of the table");
  command.flag("--no-anchors", options->no_anchors, "leave Draco and decimate-then-Draco out");
  command.on_run([options, &context] { return run_curve(*options, context); });
}

}  // namespace gsp::cli
