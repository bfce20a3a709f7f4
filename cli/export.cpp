#include "experiments/check/export.h"

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/print.h"

namespace gsp::cli {

namespace {

struct ExportArguments {
  std::string run, recipe, output;
  std::string format = "csv";
};

int run_export(const ExportArguments& options, Context& context) {
  const Store store = Store::open(options.run);
  const std::string recipe = store.plan(options.recipe).recipe;
  print_report(
      context,
      {{"files", export_cells(store.cells(recipe), recipe, export_format_of(options.format), options.output)}});
  return 0;
}

}  // namespace

void add_export(CLI::App& app, Context& context) {
  Command command(app, context, "export", "a sweep's curves for other tools");
  auto options = std::make_shared<ExportArguments>();
  command.argument("RUN", options->run, "folder of a sweep");
  command.output_folder("-o,--output", options->output, false, "folder for the files");
  command.choice("--format", options->format, export_format_words(), "what they are to be read by");
  command.optional_text("--recipe", "NAME", options->recipe, "of the recipes in the folder [the latest]");
  command.on_run([options, &context] { return run_export(*options, context); });
}

}  // namespace gsp::cli
