#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gsp {

/// Somebody else's method, which runs as a program of its own. Command lines are split into words as a shell does it,
/// but run without one (command_words.h); {input}, {output}, {value} and {folder} are replaced in them.
struct ExternalTool {
  enum class Kind {
    Codec,     ///< `encode` makes a file, whose size is the bytes; `decode` makes a surface of it
    Remesher,  ///< `remesh` makes a semi-regular mesh, which our coder codes
    Points     ///< a file has its points, measured elsewhere
  };
  /// What its curve is called, of letters, digits and . - _ +. A remesher of several values has its value behind.
  std::string name;
  Kind kind = Kind::Codec;
  std::string encode, decode;
  std::string remesh;
  std::string points;                         ///< the file (points_file.h), {folder} replaced
  std::vector<std::string> values;            ///< of {value}: one for each point of a codec's curve, one of a remesher
  std::string folder;                         ///< {folder}: where the recipe lies, absolute; no part of what is cached
  std::string input = "ply", output = "ply";  ///< formats of the surface that it reads and of the one that it writes
  double time_limit = 3600.0;                 ///< seconds of each command, 0.001 to 1e6
  std::optional<double> memory_limit;         ///< megabytes of address space of each process, from 1
  std::string version_command;                ///< prints its version; empty: the program itself tells
  std::string version;                        ///< what is known of the version when the sweep is planned (sweep/plan.h)
};

/// The tools of one [[external]] table of a recipe, given as JSON: a codec or points one, a remesher one for each of
/// its values. Reads the keys of `external_keys` and passes over others. Throws Error(BadOption) for keys of two kinds
/// or of none, missing or malformed values, unknown placeholders.
std::vector<ExternalTool> external_tools(const std::string& json, const std::string& folder);

/// "name", "encode", "decode", "remesh", "points", "values", "input", "output", "time_limit", "memory_limit",
/// "version".
std::vector<std::string> external_keys();

/// What decides on the results of a tool, as a JSON object without limits and folder; and all of it. Two runs of the
/// same former have the same results, as far as anybody can tell who does not know the program.
std::string external_key_json(const ExternalTool& tool);
std::string external_json(const ExternalTool& tool);
/// The inverse of the latter. Throws Error(Malformed).
ExternalTool external_from_json(const std::string& text);

}  // namespace gsp
