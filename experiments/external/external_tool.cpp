#include "experiments/external/external_tool.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>

#include "experiments/external/command_words.h"
#include "mesh/error.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;
using Kind = ExternalTool::Kind;

constexpr const char* kKindNames[] = {"codec", "remesher", "points"};
constexpr double kLeastSeconds = 0.001, kMostSeconds = 1e6;
constexpr double kLeastMegabytes = 1.0, kMostMegabytes = 1e7;

[[noreturn]] void refuse(const std::string& why) { throw Error(Cause::BadOption, why); }

std::string text(const Json& table, const char* key, const std::string& otherwise = "") {
  const auto found = table.find(key);
  if (found == table.end()) return otherwise;
  if (!found->is_string() || found->get_ref<const std::string&>().empty()) refuse(fmt::format("{} is no text", key));
  return found->get<std::string>();
}

double number(const Json& table, const char* key, double low, double high) {
  const Json& value = table.at(key);
  const double x = value.is_number() ? value.get<double>() : low - 1.0;
  if (!(x >= low && x <= high)) refuse(fmt::format("{} is not {} to {}", key, low, high));
  return x;
}

// Values are words of a label and of curve.csv.
bool plain(const std::string& word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '.' || c == '-' || c == '_' || c == '+';
  });
}

std::vector<std::string> values(const Json& table) {
  std::vector<std::string> words;
  const auto found = table.find("values");
  if (found == table.end()) return {""};
  if (!found->is_array() || found->empty()) refuse("values is no list of numbers or words");
  for (const Json& value : *found) {
    const std::string word = value.is_string() ? value.get<std::string>() : value.dump();
    if (value.is_structured() || !plain(word))
      refuse(fmt::format("the value {} is no number and no word of letters, digits and . - _ +", word));
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
  }
  return words;
}

std::string format(const Json& table, const char* key) {
  const std::vector<std::string> formats = {"ply", "obj", "off", "stl"};
  const std::string word = text(table, key, formats.front());
  if (std::find(formats.begin(), formats.end(), word) == formats.end())
    refuse(fmt::format("{} is none of {}", key, fmt::join(formats, ", ")));
  return word;
}

Kind kind_of(const Json& table) {
  const bool codec = table.contains("encode") || table.contains("decode");
  const bool remesher = table.contains("remesh"), points = table.contains("points");
  if (codec + remesher + points != 1) refuse("an external method has encode and decode, or remesh, or points");
  if (codec && !(table.contains("encode") && table.contains("decode"))) refuse("a codec has encode and decode");
  return codec ? Kind::Codec : remesher ? Kind::Remesher : Kind::Points;
}

// Refuses what cannot be run, so that it is known before the sweep starts.
void require_runnable(const ExternalTool& tool, bool has_values) {
  const std::map<std::string, std::string> all = {{"input", ""}, {"output", ""}, {"value", ""}, {"folder", ""}};
  for (const std::string* line : {&tool.encode, &tool.decode, &tool.remesh})
    if (!line->empty()) command_words(*line, all);
  if (!tool.version_command.empty()) command_words(tool.version_command, {{"folder", ""}});
  for (const std::string* line : {&tool.encode, &tool.remesh}) {
    if (line->empty()) continue;
    const bool takes_value = line->find("{value}") != std::string::npos;
    if (takes_value != has_values)
      refuse(takes_value ? "{value} stands in a command, and values is missing"
                         : "values is given, and no command has {value}");
  }
}

std::string with_folder(std::string path, const std::string& folder) {
  const std::string name = "{folder}";
  if (const auto at = path.find(name); at != std::string::npos) path.replace(at, name.size(), folder);
  return path;
}

}  // namespace

std::vector<std::string> external_keys() {
  return {"name",  "encode", "decode",     "remesh",       "points", "values",
          "input", "output", "time_limit", "memory_limit", "version"};
}

std::vector<ExternalTool> external_tools(const std::string& json, const std::string& folder) {
  const Json table = Json::parse(json, nullptr, false);
  if (!table.is_object()) refuse("an external method is no table");
  for (const char* key : {"method", "preset"})
    if (table.contains(key)) refuse(fmt::format("an external method is one itself and has no {}", key));
  ExternalTool tool;
  tool.kind = kind_of(table);
  tool.name = text(table, "name");
  if (!plain(tool.name)) refuse("an external method has a name, of letters, digits and . - _ +");
  tool.folder = folder;
  tool.encode = text(table, "encode");
  tool.decode = text(table, "decode");
  tool.remesh = text(table, "remesh");
  tool.points = with_folder(text(table, "points"), folder);
  tool.input = format(table, "input");
  tool.output = format(table, "output");
  tool.version_command = text(table, "version");
  if (table.contains("time_limit")) tool.time_limit = number(table, "time_limit", kLeastSeconds, kMostSeconds);
  if (table.contains("memory_limit"))
    tool.memory_limit = number(table, "memory_limit", kLeastMegabytes, kMostMegabytes);
  tool.values = values(table);
  require_runnable(tool, table.contains("values"));
  if (tool.kind != Kind::Remesher) return {tool};
  std::vector<ExternalTool> tools;
  for (const std::string& value : tool.values) {
    tools.push_back(tool);
    tools.back().values = {value};
    if (tool.values.size() > 1) tools.back().name += '-' + value;
  }
  return tools;
}

std::string external_key_json(const ExternalTool& tool) {
  return Json({{"name", tool.name},
               {"kind", kKindNames[static_cast<int>(tool.kind)]},
               {"encode", tool.encode},
               {"decode", tool.decode},
               {"remesh", tool.remesh},
               {"points", tool.points},
               {"values", tool.values},
               {"input", tool.input},
               {"output", tool.output},
               {"version", tool.version}})
      .dump();
}

std::string external_json(const ExternalTool& tool) {
  Json object = Json::parse(external_key_json(tool));
  object["folder"] = tool.folder;
  object["time_limit"] = tool.time_limit;
  if (tool.memory_limit) object["memory_limit"] = *tool.memory_limit;
  object["version_command"] = tool.version_command;
  return object.dump();
}

ExternalTool external_from_json(const std::string& text) try {
  const Json object = Json::parse(text);
  ExternalTool tool;
  const std::string kind = object.at("kind").get<std::string>();
  const auto name = std::find(std::begin(kKindNames), std::end(kKindNames), kind);
  if (name == std::end(kKindNames)) throw Error(Cause::Malformed, "no kind of external method: " + kind);
  tool.kind = static_cast<Kind>(name - std::begin(kKindNames));
  for (const auto& [key, member] : {std::pair{"name", &tool.name},
                                    {"encode", &tool.encode},
                                    {"decode", &tool.decode},
                                    {"remesh", &tool.remesh},
                                    {"points", &tool.points},
                                    {"folder", &tool.folder},
                                    {"input", &tool.input},
                                    {"output", &tool.output},
                                    {"version_command", &tool.version_command},
                                    {"version", &tool.version}})
    *member = object.at(key).get<std::string>();
  tool.values = object.at("values").get<std::vector<std::string>>();
  tool.time_limit = object.at("time_limit").get<double>();
  if (object.contains("memory_limit")) tool.memory_limit = object["memory_limit"].get<double>();
  return tool;
} catch (const Json::exception& error) {
  throw Error(Cause::Malformed, std::string("an external method: ") + error.what());
}

}  // namespace gsp
