#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "coder/codec.h"
#include "experiments/external/external_tool.h"
#include "param/parameterize.h"
#include "remesh/remesh.h"

namespace gsp {

/// What a cell of a sweep is computed by, in this order. An anchor (Draco) has the last one only, as an external codec
/// has; an external remesher has all but the first.
enum class StageKind { Parameterize, Remesh, Encode, Measure };
inline constexpr StageKind kStageKinds[] = {StageKind::Parameterize, StageKind::Remesh, StageKind::Encode,
                                            StageKind::Measure};

/// "parameterize", "remesh", "encode", "measure".
const char* stage_name(StageKind kind);
/// The inverse. Throws Error(BadOption).
StageKind stage_of(const std::string& name);

/// How each size of a remesh is coded.
enum class StreamMode {
  Embedded,  ///< as the prefix of one stream, which serves every size (`encode`)
  Fixed      ///< as a stream made for that size alone (`encode_fixed`)
};

inline constexpr StreamMode kStreamModes[] = {StreamMode::Embedded, StreamMode::Fixed};

/// "embedded", "fixed".
const char* stream_mode_name(StreamMode mode);
/// The inverse. Throws Error(BadOption).
StreamMode stream_mode_of(const std::string& name);
/// What the column `coder` of curve.csv calls it: "gsp", "gsp-fixed".
const char* coder_name(StreamMode mode);

/// Most replicates of one cell that are asked for at once.
inline constexpr int kMostReplicates = 1000;

/// Everything that a cell depends on besides its surface.
struct CellOptions {
  std::string method = "gsp";                 ///< of `method_words`, or the name of `external`
  std::optional<ExternalTool> external = {};  ///< somebody else's method, which runs by command line
  ParameterizeOptions parameterize = {.base_vertices = kBaseByRate};  ///< whose `method` says nothing here
  RemeshOptions remesh;
  EncodeOptions encode;
  StreamMode mode = StreamMode::Embedded;
  std::vector<std::size_t> budgets;  ///< bytes to decode; empty: 256, 512, 1024, ... and the whole stream
  std::size_t samples = 200000;      ///< of the distance, per direction; decimations, which have many points, take half
  std::uint64_t seed = 1;            ///< of the samples; they measure the remesh too
};

/// The words of `CellOptions::method`, and those that stand for maps.
std::vector<std::string> method_words();
std::vector<std::string> map_method_words();
/// The others, which have no map: "draco", the input coded by Draco; "decimate-draco", the same after decimation by
/// quadrics; "lindstrom-turk-draco", the same after the decimation that keeps the volume (coder/anchors.h).
const std::vector<std::string>& anchor_words();
/// True for one of them.
bool is_anchor(const std::string& method);

/// The stages of a cell, in order.
std::vector<StageKind> stages_of(const CellOptions& options);
/// True for a map of gsp's or a baseline's, which starts with the stage Parameterize.
bool has_map(const CellOptions& options);
/// True where a remesh is coded by our coder: a map's, or that of an external remesher.
bool has_remesh(const CellOptions& options);

/// "default" and "paper": what options of the map are where none is given.
std::vector<std::string> preset_words();
/// The options that one stands for. Throws Error(BadOption) for unknown words.
ParameterizeOptions preset_options(const std::string& word);

/// One value of one option: an integer, a number, or a word ("auto" where the option has it).
using AxisValue = std::variant<std::int64_t, double, std::string>;

/// One option that a recipe may vary. All that must be known about it stands here once: recipes, cache keys, labels and
/// the command line follow from it, so a new option of a stage is one entry in `axes`.
struct Axis {
  enum class Kind { Integer, Number, Word };
  /// The methods for which it changes anything.
  enum class Scope {
    Every,  ///< the anchors and external methods too
    Maps,   ///< all maps; what codes a remesh and measures it also external remeshers
    Gsp,
    GspAndHybrid
  };
  const char* name;
  StageKind stage;  ///< the first stage whose result it changes
  Kind kind;
  double low = 0.0, high = 0.0;    ///< inclusive, of integers and numbers
  std::vector<std::string> words;  ///< for a word all there are; for an integer those it has besides, or "auto"
  AxisValue (*get)(const CellOptions&);
  /// The value has passed `refusal`.
  void (*set)(CellOptions&, const AxisValue&);
  Scope scope = Scope::Maps;
  bool has_column = false;  ///< true where curve.csv has a column for it, so that `further_options` leaves it out
  /// True where another value repeats the experiment and asks no other question: labels leave it out, and cells of one
  /// model that differ in nothing else are replicates of one.
  bool repeats = false;

  /// Why a value is impossible ("-1 is not 0 to 1000"); empty where it is fine.
  std::string refusal(const AxisValue& value) const;
  /// False where the option changes nothing for the cell's method, as the level for Draco.
  bool applies_to(const CellOptions& options) const;
};

/// All axes, in the order in which a sweep nests them: the method outermost.
const std::vector<Axis>& axes();
/// Throws Error(BadOption) where there is none of that name.
const Axis& axis(const std::string& name);

/// "0.5", "16", "auto".
std::string to_string(const AxisValue& value);

/// Options that do not apply to the method are set to their defaults, so that equal cells are equal.
CellOptions normalized(CellOptions options);

/// Normalized, and each once, in order.
std::vector<CellOptions> distinct(const std::vector<CellOptions>& cells);

/// Whether the map of `cell` is what `made` gives for the cell's method: all options that apply to that method's map
/// are the same. Maps of one `ParameterizeOptions` are made together where this holds.
bool same_map_options(const CellOptions& cell, const CellOptions& made);

/// The options that decide on the base complex, which the baselines of a surface share with the first map on it, as
/// JSON.
std::string base_options_json(const CellOptions& options);

/// The options of one stage as a JSON object, only those that apply to the method, keys in the order of `axes`; the
/// method and `external` are part of the stage that depends on them first, the budgets of Measure.
std::string options_json(const CellOptions& options, StageKind stage);
/// All options that apply, as one JSON object.
std::string options_json(const CellOptions& options);
/// The inverse of the latter. Throws Error(Malformed, BadOption).
CellOptions options_from_json(const std::string& text);

/// All options that have no column of their own in curve.csv, as "name=value name=value".
std::string further_options(const CellOptions& options);
/// The value of one of them in that text; empty where it has none.
std::string further_option(const std::string& text, const std::string& name);

}  // namespace gsp
