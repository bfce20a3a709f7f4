#include "experiments/report/report.h"

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/print.h"
#include "experiments/output/quoting.h"

namespace gsp::cli {

namespace {

struct ReportArguments {
  std::string run, output;
  bool no_figures = false;
  ReportOptions report;
};

int run_report(ReportArguments& options, Context& context) {
  Progress progress = context.console.progress();
  options.report.figures = !options.no_figures;
  const ReportResult result = make_report(options.run, options.output, options.report, progress);
  if (context.json) {
    print_report(
        context,
        {{"reference", result.findings.reference}, {"sentences", result.findings.sentences}, {"files", result.files}});
    return 0;
  }
  for (const std::string& sentence : result.findings.sentences) context.out << printable(sentence) << '\n';
  context.out << printable(result.files.front()) << '\n';
  return 0;
}

}  // namespace

void add_report(CLI::App& app, Context& context) {
  Command command(app, context, "report",
                  "a page that answers what a run was for: sentences, curves, surfaces, figures");
  auto options = std::make_shared<ReportArguments>();
  command.argument("RUN", options->run, "store of gsp sweep, or folder of gsp curve");
  command.output_folder("-o,--output", options->output, false,
                        "folder for index.html, which opens from disk, and what it shows");
  command.text("--recipe", options->report.recipe, "of a store with several", "the latest");
  command.integer("--views", options->report.views, 0, 100, "cells of each model in the 3D view, a few MB each");
  command.flag("--stored-surfaces", options->report.stored_surfaces,
               "views hold surfaces of eight sizes, for browsers without WebAssembly, instead of the streams");
  command.integer("--map-models", options->report.map_models, 0, 100'000,
                  "models whose maps are drawn, the first of the run; curves and costs are drawn of all");
  command.flag("--no-figures", options->no_figures, "leave the figures out, and with them gnuplot");
  command.on_run([options, &context] { return run_report(*options, context); });
}

}  // namespace gsp::cli
