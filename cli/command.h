#pragma once

#include <functional>
#include <iosfwd>

#include "cli/console.h"

namespace CLI {
class App;
}

namespace gsp::cli {

/// What every command gets: where its data go, how it talks, and what it returns.
struct Context {
  std::ostream& out;
  Console console;
  bool json = false;
  int threads = 0;
  /// Set by the chosen command once all its options are checked. Returns the exit status.
  std::function<int()> action;
};

// Each adds one subcommand: its options with defaults and ranges, and the action that reads, calls and prints.
void add_info(CLI::App& app, Context& context);
void add_parameterize(CLI::App& app, Context& context);
void add_remesh(CLI::App& app, Context& context);
void add_encode(CLI::App& app, Context& context);
void add_decode(CLI::App& app, Context& context);
void add_distance(CLI::App& app, Context& context);
void add_distortion(CLI::App& app, Context& context);
void add_curve(CLI::App& app, Context& context);
void add_picture(CLI::App& app, Context& context);
void add_report(CLI::App& app, Context& context);
void add_play(CLI::App& app, Context& context);
void add_baseline(CLI::App& app, Context& context);
void add_check(CLI::App& app, Context& context);
void add_export(CLI::App& app, Context& context);
void add_sweep(CLI::App& app, Context& context);
void add_sweep_worker(CLI::App& app, Context& context);

}  // namespace gsp::cli
