#include "experiments/cells/cell_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "mesh/words.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;
using Kind = Axis::Kind;
using Scope = Axis::Scope;

constexpr const char* kAuto = "auto";
constexpr const char* kExternal = "external";
const std::string kAutoOmega = "auto-omega", kNone = "none";
constexpr double kMostWeight = 1e6;
constexpr int kMostRelaxations = 1000;
constexpr int kMostReplicate = 1000000;
// Values of Axis::has_column and Axis::repeats.
constexpr bool kColumn = true, kRepeats = true;
constexpr double kMostInt = std::numeric_limits<int>::max();

std::int64_t integer(const AxisValue& value) { return std::get<std::int64_t>(value); }
double number(const AxisValue& value) { return std::get<double>(value); }
const std::string& word(const AxisValue& value) { return std::get<std::string>(value); }

AxisValue integer_or_auto(int value, int automatic) {
  return value == automatic ? AxisValue(kAuto) : AxisValue(std::int64_t{value});
}

int integer_or_auto(const AxisValue& value, int automatic) {
  return std::holds_alternative<std::string>(value) ? automatic : static_cast<int>(integer(value));
}

using Options = CellOptions;
using Value = AxisValue;

std::vector<Axis> map_axes() {
  constexpr StageKind kStage = StageKind::Parameterize;
  return {
      {"method", kStage, Kind::Word, 0, 0, method_words(), [](const Options& o) { return Value(o.method); },
       [](Options& o, const Value& v) { o.method = word(v); }, Scope::Every, kColumn},
      {"gamma",
       kStage,
       Kind::Number,
       0,
       kMostWeight,
       {},
       [](const Options& o) { return Value(o.parameterize.gamma); },
       [](Options& o, const Value& v) { o.parameterize.gamma = number(v); },
       Scope::Maps,
       kColumn},
      {"mu",
       kStage,
       Kind::Number,
       0,
       kMostWeight,
       {},
       [](const Options& o) { return Value(o.parameterize.mu); },
       [](Options& o, const Value& v) { o.parameterize.mu = number(v); },
       Scope::Maps,
       kColumn},
      {"base_vertices",
       kStage,
       Kind::Integer,
       4,
       kMostInt,
       {kAuto, kAutoOmega},
       [](const Options& o) {
         return o.parameterize.base_vertices == kBaseByOmega
                    ? Value(kAutoOmega)
                    : integer_or_auto(o.parameterize.base_vertices, kBaseByRate);
       },
       [](Options& o, const Value& v) {
         o.parameterize.base_vertices = v == Value(kAutoOmega) ? kBaseByOmega : integer_or_auto(v, kBaseByRate);
       },
       Scope::Maps,
       kColumn},
      {"objective", kStage, Kind::Word, 0, 0, words_of(kObjectives, objective_name),
       [](const Options& o) { return Value(objective_name(o.parameterize.objective)); },
       [](Options& o, const Value& v) { o.parameterize.objective = objective_of(word(v)); }, Scope::Gsp},
      {"weights", kStage, Kind::Word, 0, 0, words_of(kWeights, weights_name),
       [](const Options& o) { return Value(weights_name(o.parameterize.weights)); },
       [](Options& o, const Value& v) { o.parameterize.weights = weights_of(word(v)); }, Scope::GspAndHybrid},
      {"corners", kStage, Kind::Word, 0, 0, words_of(kCorners, corners_name),
       [](const Options& o) { return Value(corners_name(o.parameterize.corners)); },
       [](Options& o, const Value& v) { o.parameterize.corners = corners_of(word(v)); }, Scope::Gsp},
      {"base_edges", kStage, Kind::Word, 0, 0, words_of(kBaseEdges, base_edges_name),
       [](const Options& o) { return Value(base_edges_name(o.parameterize.base_edges)); },
       [](Options& o, const Value& v) { o.parameterize.base_edges = base_edges_of(word(v)); }, Scope::Gsp},
      {"priority", kStage, Kind::Word, 0, 0, words_of(kPriorities, priority_name),
       [](const Options& o) { return Value(priority_name(o.parameterize.priority)); },
       [](Options& o, const Value& v) { o.parameterize.priority = priority_of(word(v)); }, Scope::Maps},
      {"features",
       kStage,
       Kind::Integer,
       1,
       179,
       {kNone, kAuto},
       [](const Options& o) {
         return o.parameterize.feature_degrees == kNoFeatures
                    ? Value(kNone)
                    : integer_or_auto(o.parameterize.feature_degrees, kAutoFeatures);
       },
       [](Options& o, const Value& v) {
         o.parameterize.feature_degrees = v == Value(kNone) ? kNoFeatures : integer_or_auto(v, kAutoFeatures);
       },
       Scope::Maps},
      {"tries",
       kStage,
       Kind::Integer,
       1,
       ParameterizeOptions::kMostTries,
       {},
       [](const Options& o) { return Value(std::int64_t{o.parameterize.tries}); },
       [](Options& o, const Value& v) { o.parameterize.tries = static_cast<int>(integer(v)); },
       Scope::Maps},
      {"relaxations",
       kStage,
       Kind::Integer,
       0,
       kMostRelaxations,
       {},
       [](const Options& o) { return Value(std::int64_t{o.parameterize.relaxations}); },
       [](Options& o, const Value& v) { o.parameterize.relaxations = static_cast<int>(integer(v)); },
       Scope::Gsp},
      {"replicate",
       kStage,
       Kind::Integer,
       0,
       kMostReplicate,
       {},
       [](const Options& o) { return Value(std::int64_t{o.parameterize.replicate}); },
       [](Options& o, const Value& v) { o.parameterize.replicate = static_cast<int>(integer(v)); },
       Scope::Maps,
       kColumn,
       kRepeats},
  };
}

std::vector<Axis> code_axes() {
  return {
      {"level",
       StageKind::Remesh,
       Kind::Integer,
       0,
       kMaxSubdivisionLevel,
       {kAuto},
       [](const Options& o) { return integer_or_auto(o.remesh.level, RemeshOptions::kAutoLevel); },
       [](Options& o, const Value& v) { o.remesh.level = integer_or_auto(v, RemeshOptions::kAutoLevel); },
       Scope::Maps,
       kColumn},
      {"kind", StageKind::Remesh, Kind::Word, 0, 0, words_of(kRemeshKinds, remesh_kind_name),
       [](const Options& o) { return Value(remesh_kind_name(o.remesh.kind)); },
       [](Options& o, const Value& v) { o.remesh.kind = remesh_kind_of(word(v)); }},
      {"predict", StageKind::Remesh, Kind::Word, 0, 0, words_of(kPredictions, prediction_name),
       [](const Options& o) { return Value(prediction_name(o.remesh.predict)); },
       [](Options& o, const Value& v) { o.remesh.predict = prediction_of(word(v)); }},
      {"normal_tolerance",
       StageKind::Remesh,
       Kind::Number,
       0,
       1,
       {},
       [](const Options& o) { return Value(o.remesh.normal_tolerance); },
       [](Options& o, const Value& v) { o.remesh.normal_tolerance = number(v); }},
      {"positions", StageKind::Remesh, Kind::Word, 0, 0, words_of(kPositions, positions_name),
       [](const Options& o) { return Value(positions_name(o.remesh.positions)); },
       [](Options& o, const Value& v) { o.remesh.positions = positions_of(word(v)); }},
      {"wavelet", StageKind::Encode, Kind::Word, 0, 0, words_of(kWavelets, wavelet_name),
       [](const Options& o) { return Value(wavelet_name(o.encode.wavelet)); },
       [](Options& o, const Value& v) { o.encode.wavelet = wavelet_of(word(v)); }, Scope::Maps, kColumn},
      {"precision_bits",
       StageKind::Encode,
       Kind::Integer,
       8,
       24,
       {kAuto},
       [](const Options& o) { return integer_or_auto(o.encode.precision_bits, EncodeOptions::kAutoPrecision); },
       [](Options& o, const Value& v) { o.encode.precision_bits = integer_or_auto(v, EncodeOptions::kAutoPrecision); }},
      {"tangential_ratio",
       StageKind::Encode,
       Kind::Integer,
       1,
       8,
       {"1", "2", "4", "8"},
       [](const Options& o) { return Value(std::int64_t{o.encode.tangential_ratio}); },
       [](Options& o, const Value& v) { o.encode.tangential_ratio = static_cast<int>(integer(v)); }},
      {"mode", StageKind::Measure, Kind::Word, 0, 0, words_of(kStreamModes, stream_mode_name),
       [](const Options& o) { return Value(stream_mode_name(o.mode)); },
       [](Options& o, const Value& v) { o.mode = stream_mode_of(word(v)); }, Scope::Maps, kColumn},
      {"samples",
       StageKind::Remesh,
       Kind::Integer,
       1000,
       1e9,
       {},
       [](const Options& o) { return Value(static_cast<std::int64_t>(o.samples)); },
       [](Options& o, const Value& v) { o.samples = static_cast<std::size_t>(integer(v)); },
       Scope::Every,
       kColumn},
      {"seed",
       StageKind::Remesh,
       Kind::Integer,
       0,
       0x1p62,
       {},
       [](const Options& o) { return Value(static_cast<std::int64_t>(o.seed)); },
       [](Options& o, const Value& v) { o.seed = static_cast<std::uint64_t>(integer(v)); },
       Scope::Every,
       kColumn},
  };
}

Json to_json(const AxisValue& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

AxisValue from_json(const Json& value) {
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  throw Error(Cause::Malformed, "an option is neither a number nor a word");
}

// An option of a stage that the method does not have counts for the first that it has.
bool belongs(const Axis& axis, const CellOptions& options, StageKind stage) {
  return axis.applies_to(options) && stage == std::max(axis.stage, stages_of(options).front());
}

void add_options(Json& object, const CellOptions& options, StageKind stage) {
  for (const Axis& axis : axes())
    if (belongs(axis, options, stage)) object[axis.name] = to_json(axis.get(options));
  if (options.external && stage == stages_of(options).front())
    object[kExternal] = Json::parse(external_key_json(*options.external));
  if (stage == StageKind::Measure && has_remesh(options)) object["budgets"] = options.budgets;
}

}  // namespace

const char* stage_name(StageKind kind) {
  switch (kind) {
    case StageKind::Parameterize:
      return "parameterize";
    case StageKind::Remesh:
      return "remesh";
    case StageKind::Encode:
      return "encode";
    case StageKind::Measure:
      break;
  }
  return "measure";
}

StageKind stage_of(const std::string& name) { return value_of(kStageKinds, stage_name, name, "stage"); }

std::vector<std::string> map_method_words() { return words_of(kMethods, method_name); }

std::vector<std::string> method_words() {
  std::vector<std::string> words = map_method_words();
  words.insert(words.end(), anchor_words().begin(), anchor_words().end());
  return words;
}

const std::vector<std::string>& anchor_words() {
  static const std::vector<std::string> words = {"draco", "decimate-draco", "lindstrom-turk-draco"};
  return words;
}

bool is_anchor(const std::string& method) {
  return std::find(anchor_words().begin(), anchor_words().end(), method) != anchor_words().end();
}

std::vector<StageKind> stages_of(const CellOptions& options) {
  if (!has_remesh(options)) return {StageKind::Measure};
  if (!has_map(options)) return {StageKind::Remesh, StageKind::Encode, StageKind::Measure};
  return {std::begin(kStageKinds), std::end(kStageKinds)};
}

bool has_map(const CellOptions& options) { return !options.external && !is_anchor(options.method); }

bool has_remesh(const CellOptions& options) {
  return options.external ? options.external->kind == ExternalTool::Kind::Remesher : !is_anchor(options.method);
}

const char* stream_mode_name(StreamMode mode) { return mode == StreamMode::Fixed ? "fixed" : "embedded"; }

StreamMode stream_mode_of(const std::string& name) { return value_of(kStreamModes, stream_mode_name, name, "mode"); }

const char* coder_name(StreamMode mode) { return mode == StreamMode::Fixed ? "gsp-fixed" : "gsp"; }

std::vector<std::string> preset_words() { return {"default", "paper"}; }

ParameterizeOptions preset_options(const std::string& word) {
  if (word == "default") return CellOptions().parameterize;
  if (word == "paper") return paper_options();
  throw Error(Cause::BadOption, "unknown preset " + word);
}

std::string Axis::refusal(const AxisValue& value) const {
  const std::string text = to_string(value);
  if (!words.empty() && std::find(words.begin(), words.end(), text) != words.end()) return {};
  const bool range = kind == Kind::Number || (kind == Kind::Integer && (words.empty() || words.front() == kAuto));
  if (!range) return fmt::format("{} is none of {}", text, fmt::join(words, ", "));
  const bool fits =
      kind == Kind::Number ? std::holds_alternative<double>(value) : std::holds_alternative<std::int64_t>(value);
  const double x = !fits                  ? std::numeric_limits<double>::quiet_NaN()
                   : kind == Kind::Number ? number(value)
                                          : static_cast<double>(integer(value));
  if (x >= low && x <= high) return {};
  return fmt::format("{} is not {}{} to {}{}", text, kind == Kind::Integer ? "an integer " : "", low, high,
                     words.empty() ? "" : fmt::format(" or {}", fmt::join(words, " or ")));
}

bool Axis::applies_to(const CellOptions& options) const {
  if (scope == Scope::Every) return true;
  if (!has_map(options)) return has_remesh(options) && scope == Scope::Maps && stage >= StageKind::Encode;
  const bool gsp = options.method == method_name(Method::Gsp);
  switch (scope) {
    case Scope::Every:
    case Scope::Maps:
      return true;
    case Scope::Gsp:
      return gsp;
    case Scope::GspAndHybrid:
      break;
  }
  return gsp || options.method == method_name(Method::Hybrid);
}

const std::vector<Axis>& axes() {
  static const std::vector<Axis> all = [] {
    std::vector<Axis> list = map_axes();
    for (Axis& axis : code_axes()) list.push_back(std::move(axis));
    return list;
  }();
  return all;
}

const Axis& axis(const std::string& name) {
  for (const Axis& axis : axes())
    if (name == axis.name) return axis;
  throw Error(Cause::BadOption, "unknown option " + name);
}

std::string to_string(const AxisValue& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

CellOptions normalized(CellOptions options) {
  const CellOptions defaults;
  for (const Axis& axis : axes())
    if (!axis.applies_to(options)) axis.set(options, axis.get(defaults));
  if (!has_remesh(options)) options.budgets.clear();
  return options;
}

std::vector<CellOptions> distinct(const std::vector<CellOptions>& cells) {
  std::set<std::string> seen;
  std::vector<CellOptions> unique;
  for (const CellOptions& cell : cells) {
    CellOptions options = normalized(cell);
    if (seen.insert(options_json(options)).second) unique.push_back(std::move(options));
  }
  return unique;
}

bool same_map_options(const CellOptions& cell, const CellOptions& made) {
  return std::all_of(axes().begin(), axes().end(), [&](const Axis& axis) {
    const bool of_map = axis.stage == StageKind::Parameterize && std::string("method") != axis.name;
    return !of_map || !axis.applies_to(cell) || axis.get(cell) == axis.get(made);
  });
}

std::string base_options_json(const CellOptions& options) {
  CellOptions base = options;
  base.method = method_name(Method::Maps);  // whose map depends on the base alone
  return options_json(normalized(std::move(base)), StageKind::Parameterize);
}

std::string options_json(const CellOptions& options, StageKind stage) {
  Json object = Json::object();
  add_options(object, options, stage);
  return object.dump();
}

std::string options_json(const CellOptions& options) {
  Json object = Json::object();
  for (StageKind stage : kStageKinds) add_options(object, options, stage);
  if (options.external) object[kExternal] = Json::parse(external_json(*options.external));
  return object.dump();
}

CellOptions options_from_json(const std::string& text) {
  const Json object = Json::parse(text, nullptr, false);
  if (!object.is_object()) throw Error(Cause::Malformed, "a cell's options are no JSON object");
  CellOptions options;
  for (const auto& [name, value] : object.items()) {
    if (name == "budgets") {
      for (const Json& bytes : value) {
        if (!bytes.is_number_unsigned()) throw Error(Cause::Malformed, "a budget is no number of bytes");
        options.budgets.push_back(bytes.get<std::size_t>());
      }
      continue;
    }
    if (name == kExternal) {
      options.external = external_from_json(value.dump());
      options.method = options.external->name;
      continue;
    }
    if (name == "method" && object.contains(kExternal)) continue;
    const Axis& known = axis(name);
    AxisValue given = from_json(value);
    if (const std::string why = known.refusal(given); !why.empty()) throw Error(Cause::BadOption, name + ": " + why);
    known.set(options, given);
  }
  return options;
}

std::string further_options(const CellOptions& options) {
  std::string text;
  for (const Axis& axis : axes()) {
    if (axis.has_column || !axis.applies_to(options)) continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", axis.name, to_string(axis.get(options)));
  }
  return text;
}

std::string further_option(const std::string& text, const std::string& name) {
  std::istringstream words(text);
  for (std::string word; words >> word;)
    if (word.starts_with(name + '=')) return word.substr(name.size() + 1);
  return "";
}

}  // namespace gsp
