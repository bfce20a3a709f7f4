#include "cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/cells/cell_options.h"
#include "mesh/words.h"

namespace gsp::cli {

namespace {

template <class T>
bool parse(const std::string& text, T& value) {
  // CLI11 wraps -1 around for an unsigned type, as strtoull does.
  if (std::is_unsigned_v<T> && text.find('-') != std::string::npos) return false;
  return CLI::detail::lexical_cast(text, value);
}

// x, -x, ... or X,Y,Z; false where it is neither.
bool parse_direction(const std::string& word, Vec3& value) {
  const std::string axes = "xyz";
  const std::size_t axis = word.empty() ? std::string::npos : axes.find(word.back());
  if (axis != std::string::npos && (word.size() == 1 || (word.size() == 2 && word[0] == '-'))) {
    value = (word.size() == 1 ? 1.0 : -1.0) * Vec3::Unit(static_cast<Eigen::Index>(axis));
    return true;
  }
  const std::vector<std::string> numbers = CLI::detail::split(word, ',');
  if (numbers.size() != 3) return false;
  for (int k = 0; k < 3; ++k)
    if (!parse(numbers[k], value[k])) return false;
  return std::isfinite(value.norm()) && value.norm() > 0.0;
}

template <class T>
std::string range_of(T low, T high) {
  if (high == std::numeric_limits<T>::max()) return fmt::format("at least {}", low);
  return fmt::format("{} to {}", low, high);
}

// Why a text is no value in [low, high], empty where it is one. CLI11's own Range accepts NaN.
template <class T>
std::string refusal(const std::string& text, T low, T high, const std::string& range) {
  T value{};
  if (parse(text, value) && value >= low && value <= high) return {};
  return fmt::format("{} is not {}", text, range);
}

std::string refusal(const std::string& word, const std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), word) != words.end()) return {};
  return fmt::format("{} is none of {}", word, fmt::join(words, ", "));
}

// Default and range stand in the text instead of CLI11's "TYPE=value" column.
template <class T>
void add_bounded(CLI::App& app, const std::string& name, T& value, T low, T high, const std::string& text) {
  const std::string range = range_of(low, high);
  app.add_option(name, value, fmt::format("{} [{}; {}]", text, value, range))
      ->check([=](const std::string& given) { return refusal(given, low, high, range); })
      ->option_text(std::is_floating_point_v<T> ? "X" : "N");
}

// The option that sets an axis of a sweep.
std::string option_of(std::string axis) {
  std::replace(axis.begin(), axis.end(), '_', '-');
  return "--" + axis;
}

}  // namespace

Command::Command(CLI::App& app, Context& context, const std::string& name, const std::string& text)
    : app_(app.add_subcommand(name, text)), context_(context) {
  flag("--json", context.json, "print the result as JSON");
  flag("-q,--quiet", context.console.quiet, "say nothing but errors");
  flag("--verbose", context.console.verbose, "show every remark, such as each rejected candidate");
  constexpr int kMostThreads = 1024;
  integer("--threads", context.threads, 0, kMostThreads,
          "threads, 0 for all cores; the result is the same bits for any number");
  constexpr int kMostMegabytes = 1 << 24;
  integer("--memory-limit", context.console.memory_limit, 0, kMostMegabytes,
          "megabytes of memory after which the command gives up, 0 for none; of a map it is estimated before the work");
}

void Command::argument(const std::string& place, std::string& value, const std::string& text) {
  app_->add_option(place, value, text)->required()->option_text(" ");
  paths_.inputs.push_back(&value);
}

void Command::arguments(const std::string& place, std::vector<std::string>& values, const std::string& text) {
  app_->add_option(place, values, text)->required()->option_text("...");
  paths_.input_lists.push_back(&values);
}

void Command::output(const std::string& place, std::string& value, Content content, const std::string& text) {
  required_option("-o,--output", place, value, text);
  paths_.outputs.push_back({kRequired, &value, content});
}

void Command::output_folder(const std::string& name, std::string& value, bool beside_input, const std::string& text) {
  required_option(name, "DIR", value, text);
  paths_.folder = &value;
  paths_.folder_beside_input = beside_input;
}

void Command::required_option(const std::string& name, const std::string& place, std::string& value,
                              const std::string& text) {
  app_->add_option(name, value, text + " (required)")->required()->option_text(place);
}

void Command::optional_text(const std::string& name, const std::string& place, std::string& value,
                            const std::string& text) {
  app_->add_option(name, value, text)->option_text(place);
}

void Command::texts(const std::string& name, std::vector<std::string>& values, const std::string& place,
                    const std::string& text) {
  app_->add_option(name, values, text + " [none]")->option_text(place);
}

void Command::optional_output(const std::string& name, std::string& value, Content content, const std::string& text) {
  optional_text(name, "FILE", value, text + " [none]");
  paths_.outputs.push_back({name, &value, content});
}

void Command::optional_input(const std::string& name, std::string& value, const std::string& text) {
  optional_text(name, "FILE", value, text + " [none]");
  paths_.inputs.push_back(&value);
}

void Command::required_input(const std::string& name, std::string& value, const std::string& text) {
  required_option(name, "FILE", value, text);
  paths_.inputs.push_back(&value);
}

void Command::text(const std::string& name, std::string& value, const std::string& text, const std::string& meaning) {
  app_->add_option(name, value, fmt::format("{} [{}]", text, meaning))->option_text("TEXT");
}

void Command::flag(const std::string& name, bool& value, const std::string& text) { app_->add_flag(name, value, text); }

void Command::integer(const std::string& name, int& value, int low, int high, const std::string& text) {
  add_bounded(*app_, name, value, low, high, text);
}

void Command::size(const std::string& name, std::size_t& value, std::size_t low, std::size_t high,
                   const std::string& text) {
  add_bounded(*app_, name, value, low, high, text);
}

void Command::number(const std::string& name, double& value, double low, double high, const std::string& text) {
  add_bounded(*app_, name, value, low, high, text);
}

void Command::number_or_none(const std::string& name, double& value, double low, double high, const std::string& text) {
  const std::string range = "0 or " + range_of(low, high);
  app_->add_option(name, value, fmt::format("{} [{}; {}]", text, value, range))
      ->check([=](const std::string& given) {
        const bool none = refusal(given, 0.0, 0.0, range).empty();
        return none ? std::string() : refusal(given, low, high, range);
      })
      ->option_text("X");
}

void Command::choice(const std::string& name, std::string& value, const std::vector<std::string>& words,
                     const std::string& text) {
  app_->add_option(name, value, fmt::format("{} [{}; {}]", text, value, fmt::join(words, ", ")))
      ->check([words](const std::string& word) { return refusal(word, words); })
      ->option_text("WORD");
}

void Command::choices(const std::string& name, std::vector<std::string>& values, const std::vector<std::string>& words,
                      const std::string& text) {
  app_->add_option(name, values, fmt::format("{} [{}; {}]", text, fmt::join(values, ","), fmt::join(words, ", ")))
      ->delimiter(',')
      ->check([words](const std::string& word) { return refusal(word, words); })
      ->option_text("WORD,...");
}

void Command::sizes(const std::string& name, std::vector<std::size_t>& values, const std::string& text) {
  constexpr std::size_t kLow = 1, kHigh = std::numeric_limits<std::size_t>::max();
  app_->add_option(name, values, text)
      ->delimiter(',')
      ->check([](const std::string& given) { return refusal(given, kLow, kHigh, range_of(kLow, kHigh)); })
      ->option_text("N,...");
}

void Command::direction(const std::string& name, std::optional<Vec3>& value, const std::string& text) {
  const auto set = [&value](const std::string& word) {
    Vec3 direction;
    value.reset();
    if (parse_direction(word, direction)) value = direction;
  };
  app_->add_option_function<std::string>(name, set, text + " [auto; auto, x, -x, y, -y, z, -z or X,Y,Z]")
      ->check([](const std::string& word) {
        Vec3 direction;
        return word == "auto" || parse_direction(word, direction) ? std::string() : word + " is no direction";
      })
      ->option_text("DIR");
}

void Command::exclude(const std::string& name, const std::string& other) {
  app_->get_option(name)->excludes(app_->get_option(other));
}

void Command::hide() { app_->group(""); }

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::on_run(std::function<int()> action) {
  app_->callback([&context = context_, paths = paths_, action = std::move(action)] {
    context.action = [paths, action] {
      require_outputs(paths);
      return action();
    };
  });
}

void Command::axis_integer(const std::string& name, int& value, const std::string& text) {
  const Axis& bounds = axis(name);
  integer(option_of(name), value, static_cast<int>(bounds.low), static_cast<int>(bounds.high), text);
}

void Command::axis_number(const std::string& name, double& value, const std::string& text) {
  const Axis& bounds = axis(name);
  number(option_of(name), value, bounds.low, bounds.high, text);
}

template <class Stage>
void Command::axis_word(const std::string& name, Stage CellOptions::*stage, Stage& options, const std::string& text) {
  const Axis& bounds = axis(name);
  const bool counts = bounds.kind == Axis::Kind::Integer;
  const int low = static_cast<int>(bounds.low), high = static_cast<int>(bounds.high);
  const std::string range = counts ? fmt::format("{} or {}", range_of(low, high), fmt::join(bounds.words, " or "))
                                   : fmt::format("{}", fmt::join(bounds.words, ", "));
  CellOptions cell;
  cell.*stage = options;
  app_->add_option_function<std::string>(
          option_of(name),
          [&options, &bounds, stage, counts](const std::string& given) {
            CellOptions changed;
            changed.*stage = options;
            int number = 0;
            bounds.set(changed, counts && parse(given, number) ? AxisValue(std::int64_t{number}) : AxisValue(given));
            options = changed.*stage;
          },
          fmt::format("{} [{}; {}]", text, to_string(bounds.get(cell)), range))
      ->check([&bounds, counts, low, high, range](const std::string& given) {
        const std::string why = refusal(given, bounds.words);
        return why.empty() || !counts ? why : refusal(given, low, high, range);
      })
      ->option_text(counts ? fmt::format("N|{}", fmt::join(bounds.words, "|")) : "WORD");
}

void Command::parameterize_options(ParameterizeOptions& options) {
  // The first option is taken first, wherever it stands on the line, so all others override it.
  const std::vector<std::string> presets = preset_words();
  app_->add_option_function<std::string>(
          "--preset", [&options](const std::string& word) { options = preset_options(word); },
          fmt::format("what the options below are where they are not given: paper is its exact method [{}; {}]",
                      presets.front(), fmt::join(presets, ", ")))
      ->check([presets](const std::string& word) { return refusal(word, presets); })
      ->option_text("WORD");
  axis_word("base_vertices", &CellOptions::parameterize, options,
            "base vertices to stop at; auto is the size whose streams are best at equal bytes, auto-omega the "
            "paper's stop before metric distortion dominates the cost");
  axis_number("gamma", options.gamma, "weight of triangle shape in the cost");
  axis_number("mu", options.mu, "weight of area dispersion in the cost");
  axis_integer("relaxations", options.relaxations, "corner relaxations between solves at most");
  axis_word("objective", &CellOptions::parameterize, options,
            "what the map minimises: linear is the paper's global system");
  axis_word("corners", &CellOptions::parameterize, options,
            "how corners move between solves: the paper's relaxation, or down the energy's gradient");
  axis_word("base_edges", &CellOptions::parameterize, options,
            "whether base edges are flipped where that lowers the distortion, or kept as the simplification left them");
  axis_word("priority", &CellOptions::parameterize, options,
            "order of the vertex removals: by the cost, or MAPS' own, independent sets by area and curvature (wants a "
            "number of base vertices)");
  axis_integer(
      "tries", options.tries,
      "bases to try, of which the one is kept whose coarsest level has the least distortion once it is smooth");
  axis_word("features", &CellOptions::parameterize, options,
            "curves of sharp edges that become chains of base edges: found by themselves, or edges at N degrees and "
            "over; none for the paper's map, which runs across them");
  axis_word("weights", &CellOptions::parameterize, options, "of the linear objective and of corner relaxation");
}

void Command::read_options(ReadOptions& options) {
  constexpr double kLargest = ReadOptions::kLargestWeld;
  app_->add_option_function<std::string>(
          "--weld",
          [&options](const std::string& word) {
            double share = 0.0;
            options.weld = parse(word, share) ? share : 0.0;
          },
          fmt::format(
              "join vertices at the same place (exact), or within X of the bounding box's diagonal of each other, "
              "as in surfaces split along seams and rounded STL [none; exact or 0 to {}]",
              kLargest))
      ->check([](const std::string& word) {
        return word == "exact" ? std::string()
                               : refusal(word, 0.0, kLargest, fmt::format("exact or {}", range_of(0.0, kLargest)));
      })
      ->option_text("exact|X");
  const std::vector<std::string> repairs = words_of(kRepairs, repair_name);
  app_->add_option_function<std::string>(
          "--repair", [&options](const std::string& word) { options.repair = repair_of(word); },
          fmt::format("cut: edges of more than two faces, or of two that run the same way, and vertices of more than "
                      "one fan are cut apart after the weld; none: refused where a map is made [{}; {}]",
                      repair_name(options.repair), fmt::join(repairs, ", ")))
      ->check([repairs](const std::string& word) { return refusal(word, repairs); })
      ->option_text("WORD");
}

void Command::replicate_option(ParameterizeOptions& options) {
  axis_integer(
      "replicate", options.replicate,
      "0 takes the surface as it is; each other number decides otherwise where chance decides, by changing the "
      "cost of removals by 1e-4");
}

void Command::remesh_options(RemeshOptions& options) {
  axis_word("level", &CellOptions::remesh, options,
            "quadrisections of the base; auto is the first level with as many faces as the input, and 32768; of kind "
            "parametric a finer one where 16 KB of the stream would be cut off by that");
  axis_word("predict", &CellOptions::remesh, options,
            "of normal kinds, what details are added to: name the wavelet that codes them; butterfly-lifted with "
            "fitted positions only, loop with sampled ones");
  axis_number(
      "normal_tolerance", options.normal_tolerance,
      "of variational-normal: how far off the surface a vertex may start, over the diagonal, so that one number "
      "gives it and it is no exception");
  axis_word(
      "positions", &CellOptions::remesh, options,
      "vertices of the remesh: fitted, nearer to the surface at equal bytes; the paper's samples of it; or closest, "
      "with the least error of the remesh but up to 1.8 times the bytes");
}

void Command::kind_option(RemeshOptions& options) {
  axis_word("kind", &CellOptions::remesh, options,
            "how vertices above the base are given: by three numbers, where the map has them; or by one, along a "
            "normal of the coarser level or, displaced, of a smooth surface");
}

void Command::encode_options(std::string& wavelet, EncodeOptions& options) {
  choice("--wavelet", wavelet, axis("wavelet").words, "wavelet transform");
  axis_word("precision_bits", &CellOptions::encode, options,
            "bits of the finest step relative to the bounding box, where the whole stream ends; auto is as "
            "many as the remesh is worth");
  const std::vector<std::string> ratios = axis("tangential_ratio").words;
  app_->add_option("--tangential-ratio", options.tangential_ratio,
                   fmt::format("step of tangential over normal components [{}; {}]", options.tangential_ratio,
                               fmt::join(ratios, ", ")))
      ->check([ratios](const std::string& given) { return refusal(given, ratios); })
      ->option_text("N");
}

void Command::sampling_options(std::size_t& samples, std::uint64_t& seed) {
  const Axis& bounds = axis("samples");
  size("--samples", samples, static_cast<std::size_t>(bounds.low), static_cast<std::size_t>(bounds.high),
       "samples per direction");
  size("--seed", seed, 0, std::numeric_limits<std::uint64_t>::max(), "seed of the samples");
}

}  // namespace gsp::cli
