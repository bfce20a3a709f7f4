#include "experiments/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "cli/options.h"
#include "cli/print.h"
#include "experiments/curve/summary.h"
#include "experiments/output/quoting.h"
#include "mesh/atomic_file.h"

namespace gsp::cli {

namespace {

struct BaselineOptions {
  std::string run, recipe, output;
};

struct CheckArguments {
  std::string run, recipe, baseline, junit;
  bool ignore_times = false;
};

Baseline baseline_of_run(const std::string& run, const std::string& recipe) {
  const Store store = Store::open(run);
  const std::string name = store.plan(recipe).recipe;
  return baseline_of(name, store.cells(name));
}

int run_baseline(const BaselineOptions& options, Context& context) {
  const Baseline baseline = baseline_of_run(options.run, options.recipe);
  write_baseline(options.output, baseline);
  int replicates = 0;
  for (const BaselineRow& row : baseline.rows) replicates = std::max(replicates, row.replicates);
  Progress progress = context.console.progress();
  if (replicates == 1)
    progress.note(
        "one run: the tolerances allow for rounding alone; --replicates of gsp sweep measure what chance does");
  print_report(context, {{"recipe", baseline.recipe},
                         {"rows", baseline.rows.size()},
                         {"replicates", replicates},
                         {"output", options.output}});
  return 0;
}

void print_movements(std::ostream& out, const CheckResult& result) {
  for (const Movement& m : result.moved)
    out << printable(fmt::format("{:<10} {:<16} {:<24} {:<26} {} -> {} (allowed {})", verdict_name(m.verdict), m.model,
                                 m.label, m.what, m.before, m.after, m.allowed))
        << '\n';
}

Json check_json(const CheckResult& result) {
  Json moved = Json::array();
  for (const Movement& m : result.moved)
    moved.push_back({{"verdict", verdict_name(m.verdict)},
                     {"model", m.model},
                     {"cell", m.label},
                     {"what", m.what},
                     {"before", m.before},
                     {"after", m.after},
                     {"allowed", m.allowed}});
  return moved;
}

int run_check(const CheckArguments& options, Context& context) {
  const Baseline baseline = read_baseline(options.baseline);
  const Baseline run = baseline_of_run(options.run, options.recipe);
  const CheckResult result = check(baseline, run, {.times = !options.ignore_times});
  if (!options.junit.empty()) write_file(options.junit, junit_report(result, baseline.recipe));
  Json report = {{"passed", result.passed()},
                 {"rows", result.rows.size()},
                 {"numbers_compared", result.compared},
                 {"rows_without_bd_rate", result.without_bd},
                 {"bd_ceiling_margin_db", kCeilingMarginDb},
                 {"baseline_version", baseline.version}};
  if (context.json)
    report["moved"] = check_json(result);
  else
    print_movements(context.out, result);
  print_report(context, report);
  return result.passed() ? 0 : 1;
}

}  // namespace

void add_baseline(CLI::App& app, Context& context) {
  Command command(app, context, "baseline", "write down what a sweep measured, to hold later ones to it");
  auto options = std::make_shared<BaselineOptions>();
  command.argument("RUN", options->run, "folder of a sweep");
  command.output("FILE", options->output, Content::Json, "the baseline, JSON; its tolerances may be edited");
  command.optional_text("--recipe", "NAME", options->recipe, "of the recipes in the folder [the latest]");
  command.on_run([options, &context] { return run_baseline(*options, context); });
}

void add_check(CLI::App& app, Context& context) {
  Command command(app, context, "check", "hold a sweep to a baseline; exit status 1 on a regression, rows named");
  auto options = std::make_shared<CheckArguments>();
  command.argument("RUN", options->run, "folder of a sweep");
  command.required_input("--baseline", options->baseline, "what gsp baseline wrote");
  command.optional_text("--recipe", "NAME", options->recipe, "of the recipes in the folder [the latest]");
  command.optional_output("--junit", options->junit, Content::Xml, "also write the result as JUnit XML");
  command.flag("--ignore-times", options->ignore_times, "compare only what does not depend on the machine");
  command.on_run([options, &context] { return run_check(*options, context); });
}

}  // namespace gsp::cli
