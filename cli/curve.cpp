#include "experiments/curve.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "cli/options.h"
#include "cli/report.h"
#include "experiments/cell_options.h"
#include "experiments/curve_job.h"
#include "experiments/models.h"

namespace gsp::cli {

namespace {

struct Options {
  std::vector<std::string> meshes;
  std::string output;
  std::vector<std::string> methods = {"gsp", "maps-smoothed"};
  std::string wavelet = "loop";
  bool no_anchors = false;
  CurveOptions curve;
};

Json optional(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json method_report(const MethodSummary& m) {
  Json bytes_at = Json::object();
  for (std::size_t i = 0; i < m.bytes_at.size(); ++i)
    bytes_at[std::to_string(static_cast<int>(kTableLevelsDb[i])) + "_db"] = optional(m.bytes_at[i]);
  Json report = {{"method", m.method}, {"bytes_at", bytes_at}};
  if (m.base_vertices > 0)
    report.update({{"base_vertices", m.base_vertices},
                   {"base_faces", m.base_faces},
                   {"level", m.level},
                   {"ceiling_db", m.ceiling_db}});
  if (m.gain)
    report["gain"] = {{"mean_db", m.gain->mean_db}, {"from_bytes", m.gain->from_bytes}, {"to_bytes", m.gain->to_bytes}};
  if (m.bytes_ratio) report["bytes_ratio"] = *m.bytes_ratio;
  return report;
}

Json job_report(const CurveJobResult& job) {
  Json models = Json::array();
  for (const CurveSummary& summary : job.models) {
    Json methods = Json::array();
    for (const MethodSummary& m : summary.methods) methods.push_back(method_report(m));
    Json model = {{"model", summary.model}, {"methods", methods}};
    if (!summary.failure.empty()) model["error"] = {{"cause", summary.cause}, {"message", summary.failure}};
    models.push_back(model);
  }
  return {{"models", models}, {"files", job.files}};
}

int run_curve(Options& options, Context& context) {
  Progress progress = context.console.progress();
  options.curve.methods.clear();
  for (const std::string& word : options.methods) options.curve.methods.push_back(method_of(word));
  options.curve.anchors = !options.no_anchors;
  options.curve.encode.wavelet = wavelet_of(options.wavelet);
  const CurveJobResult job = curve_job(surface_files(options.meshes), options.output, options.curve, progress);
  if (context.json) {
    print_report(context, job_report(job));
  } else {
    print_summaries(context.out, job.models);
    context.out << "files\n";
    for (const std::string& file : job.files) context.out << "  " << file << '\n';
  }
  return job.failed() ? 1 : 0;
}

}  // namespace

void add_curve(CLI::App& app, Context& context) {
  Command command(app, context, "curve", "the main job: rate-distortion curves of surfaces");
  auto options = std::make_shared<Options>();
  command.arguments("MESH", options->meshes, "surfaces, or folders of them: PLY, OBJ, OFF, STL");
  command.output("DIR", options->output, "folder for curve.csv and the figures");
  command.choices("--methods", options->methods, map_method_words(), "maps to compare on one base complex");
  command.parameterize_options(options->curve.parameterize);
  command.level_option(options->curve.remesh);
  command.encode_options(options->wavelet, options->curve.encode);
  command.sizes("--budgets", options->curve.budgets, "bytes to decode [256, 512, 1024, ... and the whole stream]");
  command.sampling_options(options->curve.samples, options->curve.seed);
  command.flag("--no-anchors", options->no_anchors, "leave Draco and decimate-then-Draco out");
  command.on_run([options, &context] { return run_curve(*options, context); });
}

}  // namespace gsp::cli
