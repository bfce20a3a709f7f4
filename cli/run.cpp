#include "cli/run.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/manual.h"
#include "cli/print.h"
#include "experiments/cells/suggest.h"
#include "experiments/version.h"
#include "mesh/atomic_file.h"
#include "mesh/parallel.h"

namespace gsp::cli {

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

// The program as its own author of man pages and completions, for the build.
void add_manual(CLI::App& app, Context& context) {
  CLI::App* const command = app.add_subcommand("manual", "man pages and shell completions, into DIR");
  const auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder)->required();
  command->group("");
  command->callback([&app, &context, folder] {
    context.action = [&app, folder] {
      for (const ManualFile& page : manual(app)) {
        const std::filesystem::path path = std::filesystem::path(*folder) / page.path;
        std::filesystem::create_directories(path.parent_path());
        write_file(path.string(), page.text);
      }
      return 0;
    };
  });
}

void add_commands(CLI::App& app, Context& context) {
  app.set_version_flag("--version", std::string("gsp ") + version());
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 done, 1 failed, 2 wrong usage, 3 unusable input, 130 interrupted.\n"
      "Data go to standard output, progress and errors to standard error. gsp COMMAND --help lists a command's "
      "options.");
  add_manual(app, context);
  const std::vector<std::pair<const char*, std::vector<void (*)(CLI::App&, Context&)>>> steps = {
      {"The whole chain", {add_curve, add_report}},
      {"Surfaces", {add_info, add_distance, add_picture}},
      {"Step by step", {add_parameterize, add_distortion, add_remesh, add_encode, add_decode, add_play}},
      {"Many runs", {add_sweep, add_sweep_worker, add_baseline, add_check, add_export}}};
  for (const auto& [step, commands] : steps)
    for (const auto& add : commands) {
      add(app, context);
      CLI::App* const command = app.get_subcommands({}).back();
      if (!command->get_group().empty()) command->group(step);  // hidden ones have none
    }
}

std::string meant(const std::string& word, const std::vector<std::string>& known) {
  const std::string nearest = nearest_word(word, known);
  return word + (nearest.empty() ? "" : "; did you mean " + nearest + "?");
}

// What was typed that no command knows, with the word that was probably meant; empty where all was known.
std::string unknown_word(CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const std::vector<std::string> rest = app.remaining(true);
  const auto is_option = [](const std::string& word) { return word[0] == '-'; };
  const auto option = std::find_if(rest.begin(), rest.end(), is_option);
  const auto word = std::find_if_not(rest.begin(), rest.end(), is_option);
  std::vector<std::string> known;
  // Without a command its options are unknown too; with one, an unknown option explains what follows it.
  if (chosen.empty() && word != rest.end()) {
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
    return "unknown command " + meant(*word, known);
  }
  if (option != rest.end()) {
    for (const CLI::Option* o : (chosen.empty() ? &app : chosen.front())->get_options())
      for (const std::string& name : o->get_lnames()) known.push_back("--" + name);
    return "unknown option " + meant(option->substr(0, option->find('=')), known);
  }
  return word == rest.end() ? std::string() : "unexpected argument " + *word;
}

int usage_error(CLI::App& app, const CLI::ParseError& error, Context& context) {
  const std::string unknown = unknown_word(app);
  context.console.error("gsp: " + (unknown.empty() ? std::string(error.what()) : unknown));
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  context.console.error("gsp " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") +
                        "--help lists what there is");
  return kWrongUsage;
}

int report_failure(Context& context, const Error& error) {
  context.console.error(std::string("gsp: ") + error.what());
  if (context.json) print_report(context, {{"error", error_report(error)}});
  return error.cause() == Cause::Cancelled && interrupted() ? kInterruptedStatus : exit_status(error.cause());
}

int act(Context& context) {
  try {
    set_thread_count(context.threads);
    return context.action();
  } catch (const Error& error) {
    return report_failure(context, error);
  } catch (const std::filesystem::filesystem_error& error) {
    return report_failure(context,
                          {Cause::CannotWrite, "cannot use " + error.path1().string() + ": " + error.code().message()});
  } catch (const std::bad_alloc&) {
    return report_failure(context, {Cause::OutOfMemory, "not enough memory"});
  } catch (const std::exception& error) {
    return report_failure(context, {Cause::Internal, error.what()});
  }
}

// The status of a run whose data have reached standard output, and a failure where they have not.
int delivered(std::ostream& out, std::ostream& err, int status) {
  errno = 0;
  out.flush();
  if (out.good()) return status;
  err << "gsp: standard output cannot be written" << (errno != 0 ? std::string(": ") + std::strerror(errno) : "")
      << '\n';
  return status == 0 ? kFailed : status;
}

}  // namespace

int run(const std::vector<std::string>& args, std::ostream& out, std::ostream& err) {
  Context context{.out = out, .console = Console(err), .action = {}};
  CLI::App app("gsp: globally smooth parameterizations, judged by rate-distortion curves", "gsp");
  try {
    add_commands(app, context);
    app.parse(std::vector<std::string>(args.rbegin(), args.rend()));
  } catch (const CLI::Success& request) {
    return delivered(out, err, app.exit(request, out, err));
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, context);
  }
  return delivered(out, err, act(context));
}

}  // namespace gsp::cli
