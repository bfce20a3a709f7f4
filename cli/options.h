#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/output_paths.h"
#include "coder/codec.h"
#include "experiments/cells/cell_options.h"
#include "mesh/io.h"
#include "param/parameterize.h"
#include "remesh/remesh.h"

namespace gsp::cli {

/// One subcommand and its options, over CLI11 (whose headers take eleven seconds to compile and stay in options.cpp and
/// run.cpp). Every value lives in the caller; its value at the time of the call is the default that --help shows.
/// A value outside its range, or NaN, is refused before the command starts.
class Command {
 public:
  /// Adds a subcommand with the options that all of them have: --json, --quiet, --verbose, --threads.
  Command(CLI::App& app, Context& context, const std::string& name, const std::string& text);

  /// A required argument without a dash, shown as PLACE: a file that is read, or a folder with a run.
  void argument(const std::string& place, std::string& value, const std::string& text);
  /// The same for any number of files and folders.
  void arguments(const std::string& place, std::vector<std::string>& values, const std::string& text);
  /// The required -o, --output: a file.
  void output(const std::string& place, std::string& value, Content content, const std::string& text);
  /// A required folder that is written into; it may be the one that is read where its files have other names.
  void output_folder(const std::string& name, std::string& value, bool beside_input, const std::string& text);
  void required_option(const std::string& name, const std::string& place, std::string& value, const std::string& text);
  void optional_text(const std::string& name, const std::string& place, std::string& value, const std::string& text);
  /// Any number of texts.
  void texts(const std::string& name, std::vector<std::string>& values, const std::string& place,
             const std::string& text);
  /// A further file that is written, none where the option is not given.
  void optional_output(const std::string& name, std::string& value, Content content, const std::string& text);
  /// A further file that is read.
  void optional_input(const std::string& name, std::string& value, const std::string& text);
  void required_input(const std::string& name, std::string& value, const std::string& text);
  /// Any text; where none is given it is as `meaning` says.
  void text(const std::string& name, std::string& value, const std::string& text, const std::string& meaning);
  void flag(const std::string& name, bool& value, const std::string& text);
  void integer(const std::string& name, int& value, int low, int high, const std::string& text);
  void size(const std::string& name, std::size_t& value, std::size_t low, std::size_t high, const std::string& text);
  void number(const std::string& name, double& value, double low, double high, const std::string& text);
  /// The same, or 0, which stands for none.
  void number_or_none(const std::string& name, double& value, double low, double high, const std::string& text);
  /// One of a few words.
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& words,
              const std::string& text);
  /// Several of a few words, separated by commas.
  void choices(const std::string& name, std::vector<std::string>& values, const std::vector<std::string>& words,
               const std::string& text);
  /// Positive sizes, separated by commas.
  void sizes(const std::string& name, std::vector<std::size_t>& values, const std::string& text);
  /// A direction: x, -x, y, -y, z, -z, or three numbers separated by commas; auto leaves it empty.
  void direction(const std::string& name, std::optional<Vec3>& value, const std::string& text);
  /// Of two options only one may be given.
  void exclude(const std::string& name, const std::string& other);
  /// Leaves the command out of the list of commands.
  void hide();
  /// What --help ends with.
  void footer(const std::string& text);
  /// What the command does when all its options are right and its outputs can be written (`require_outputs`).
  void on_run(std::function<int()> action);

  /// --weld, --repair: how the surfaces of the command are read.
  void read_options(ReadOptions& options);
  // The options of a stage, the same wherever the stage is run.
  void parameterize_options(ParameterizeOptions& options);
  void replicate_option(ParameterizeOptions& options);
  void remesh_options(RemeshOptions& options);
  /// --kind apart, since a curve takes several.
  void kind_option(RemeshOptions& options);
  void encode_options(std::string& wavelet, EncodeOptions& options);
  void sampling_options(std::size_t& samples, std::uint64_t& seed);

 private:
  // Options with the bounds of the axis of that name.
  void axis_integer(const std::string& name, int& value, const std::string& text);
  /// One of the axis' words, or where it counts a number too. `options`: the command's own of one stage, which is the
  /// member `stage` of a cell's.
  template <class Stage>
  void axis_word(const std::string& name, Stage CellOptions::*stage, Stage& options, const std::string& text);
  void axis_number(const std::string& name, double& value, const std::string& text);

  CommandPaths paths_;
  CLI::App* app_;
  Context& context_;
};

}  // namespace gsp::cli
