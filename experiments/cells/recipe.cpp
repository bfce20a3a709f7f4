#include "experiments/cells/recipe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "experiments/cells/models.h"
#include "experiments/cells/recipe_models.h"
#include "experiments/cells/suggest.h"
#include "experiments/cells/value_range.h"
#include "mesh/read_file.h"
#include "mesh/words.h"

namespace gsp {

namespace {

constexpr std::size_t kMostCells = 100000;
constexpr const char* kReplicates = "replicates";

long long line_of(const toml::node& node) { return node.source().begin.line; }

[[noreturn]] void refuse(const std::string& why, long long line) {
  throw Error(Cause::BadOption, why, Element::Line, line);
}

// Values of an axis, from a scalar, a list of them or a range.
class AxisReader {
 public:
  AxisReader(const Axis& axis, const toml::node& node) : axis_(axis), line_(line_of(node)) {
    if (const toml::array* list = node.as_array()) {
      if (list->empty()) refuse(fmt::format("{} is an empty list: the sweep would have no cell", axis.name), line_);
      for (const toml::node& element : *list) add_scalar(element);
    } else if (const toml::table* range = node.as_table()) {
      add_range(*range);
    } else {
      add_scalar(node);
    }
  }

  std::vector<AxisValue> values;

 private:
  void add(AxisValue value, long long line) {
    if (axis_.kind == Axis::Kind::Number && std::holds_alternative<std::int64_t>(value))
      value = static_cast<double>(std::get<std::int64_t>(value));
    if (const std::string why = axis_.refusal(value); !why.empty())
      refuse(fmt::format("{}: {}", axis_.name, why), line);
    if (seen_.insert(value).second) values.push_back(std::move(value));
    if (values.size() > kMostCells) refuse(fmt::format("{} has more than {} values", axis_.name, kMostCells), line);
  }

  void add_scalar(const toml::node& node) {
    const long long line = line_of(node);
    if (node.is_integer()) return add(node.ref<std::int64_t>(), line);
    if (node.is_floating_point()) return add(node.ref<double>(), line);
    if (node.is_string()) return add(node.ref<std::string>(), line);
    refuse(fmt::format("{} is no number, word, list or range of them", axis_.name), line);
  }

  double number(const toml::table& range, const char* key) const {
    const toml::node* node = range.get(key);
    if (!node) refuse(fmt::format("the range of {} lacks \"{}\"", axis_.name, key), line_);
    const auto value = node->value<double>();
    if (!value || !std::isfinite(*value)) refuse(fmt::format("\"{}\" of {} is no number", key, axis_.name), line_);
    return *value;
  }

  void add_range(const toml::table& range) {
    if (axis_.kind == Axis::Kind::Word) refuse(fmt::format("{} takes words, which have no range", axis_.name), line_);
    const double from = number(range, "from"), to = number(range, "to");
    std::string stride;
    for (const auto& [key, value] : range) {
      const std::string name(key.str());
      if (name == "from" || name == "to") continue;
      if (name != "step" && name != "steps" && name != "factor")
        refuse(fmt::format("a range has from, to and one of step, steps, factor, not {}", name), line_of(value));
      if (!stride.empty()) refuse(fmt::format("the range of {} has both {} and {}", axis_.name, stride, name), line_);
      stride = name;
    }
    if (stride.empty()) refuse(fmt::format("the range of {} lacks step, steps or factor", axis_.name), line_);
    const double by = number(range, stride.c_str());
    std::vector<double> all;
    try {
      all = range_values(from, to, stride, by, kMostCells);
    } catch (const Error& error) {
      refuse(fmt::format("the range of {} {}", axis_.name, error.what()), line_);
    }
    for (const double x : all) add_number(x);
  }
  void add_number(double x) {
    if (axis_.kind == Axis::Kind::Number) return add(x, line_);
    if (x != std::floor(x)) refuse(fmt::format("{} takes integers, the range has {}", axis_.name, x), line_);
    add(static_cast<std::int64_t>(x), line_);
  }

  const Axis& axis_;
  long long line_;
  std::set<AxisValue> seen_;
};

// The keys of a model's own table, of its block and of the file: the first that has one counts.
struct Layers {
  const toml::table* own;
  const toml::table* block;
  const toml::table& file;
  std::optional<int> replicates = {};  ///< instead of those that a key asks for

  const toml::node* get(const std::string& key) const {
    for (const toml::table* table : {own, block})
      if (const toml::node* node = table ? table->get(key) : nullptr) return node;
    return file.get(key);
  }
};

void require_known_keys(const toml::table& table, const std::vector<std::string>& further) {
  std::vector<std::string> known = {"budgets", "preset", kReplicates};
  known.insert(known.end(), further.begin(), further.end());
  for (const Axis& axis : axes()) known.emplace_back(axis.name);
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string nearest = nearest_word(name, known);
    refuse(fmt::format("unknown key {}{}", name, nearest.empty() ? "" : "; did you mean " + nearest + "?"),
           static_cast<long long>(key.source().begin.line));
  }
}

std::string text(const toml::table& table, const char* key, const std::string& otherwise) {
  const toml::node* node = table.get(key);
  if (!node) return otherwise;
  if (!node->is_string()) refuse(fmt::format("{} is no text", key), line_of(*node));
  return node->ref<std::string>();
}

std::vector<std::size_t> budgets(const Layers& layers) {
  const toml::node* node = layers.get("budgets");
  if (!node) return {};
  std::set<std::size_t> sizes;
  const toml::array* list = node->as_array();
  if (!list || list->empty())
    refuse("budgets is no list of bytes; leave it out for 256, 512, 1024, ...", line_of(*node));
  for (const toml::node& element : *list) {
    if (!element.is_integer() || element.ref<std::int64_t>() < 1)
      refuse("a budget is no positive number of bytes", line_of(element));
    sizes.insert(static_cast<std::size_t>(element.ref<std::int64_t>()));
  }
  return {sizes.begin(), sizes.end()};
}

// The tables of [[key]]; none where the file has no such key.
std::vector<const toml::table*> tables(const toml::table& file, const char* key) {
  const toml::node* node = file.get(key);
  if (!node) return {};
  const toml::array* list = node->as_array();
  if (!list || list->empty()) refuse(fmt::format("{0} is no list of tables: write [[{0}]]", key), line_of(*node));
  std::vector<const toml::table*> tables;
  for (const toml::node& table : *list) {
    if (!table.is_table()) refuse(fmt::format("{0} is no table: write [[{0}]]", key), line_of(table));
    tables.push_back(table.as_table());
  }
  return tables;
}

// The entries of `models`, and of each the table of its keys, null for none.
struct ModelList {
  std::vector<ModelEntry> entries;
  std::vector<const toml::table*> own;

  void add(const toml::node& node);
};

// A pattern, or a table that holds it as `path` beside keys for its surfaces alone.
void ModelList::add(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table) require_known_keys(*table, {"path"});
  const toml::node* pattern = table ? table->get("path") : &node;
  if (!pattern || !pattern->is_string())
    refuse("a model is no pattern of files, no shape:NAME and no table with one as path", line_of(node));
  entries.push_back({pattern->ref<std::string>(), table != nullptr, line_of(*pattern)});
  own.push_back(table);
}

ModelList model_entries(const toml::table* block, const toml::table& file) {
  ModelList models;
  const toml::node* node = Layers{nullptr, block, file}.get("models");
  if (!node) return models;
  const toml::array* list = node->as_array();
  if (!list || list->empty()) refuse("models is no list of patterns: the sweep would have no cell", line_of(*node));
  const bool above = !block || !block->get("models");
  for (const toml::node& element : *list) {
    models.add(element);
    if (!block || !above || !models.own.back()) continue;
    for (const auto& [key, value] : *models.own.back())
      if (const toml::node* both = block->get(key.str()))
        refuse(fmt::format("{} is set here and for {} above (line {}): give the block models of its own",
                           std::string(key.str()), models.entries.back().pattern, line_of(value)),
               line_of(*both));
  }
  return models;
}

// Cells with what the map's options are where no other key sets them.
std::vector<CellOptions> presets(const Layers& layers) {
  const toml::node* node = layers.get("preset");
  if (!node) return {CellOptions()};
  const toml::array* list = node->as_array();
  if (list && list->empty()) refuse("preset is an empty list: the sweep would have no cell", line_of(*node));
  std::vector<CellOptions> found;
  for (std::size_t i = 0; i < (list ? list->size() : 1); ++i) {
    const toml::node& word = list ? *list->get(i) : *node;
    const std::vector<std::string> words = preset_words();
    if (!word.is_string() || std::find(words.begin(), words.end(), word.ref<std::string>()) == words.end())
      refuse(fmt::format("preset is none of {}", fmt::join(words, ", ")), line_of(word));
    found.emplace_back().parameterize = preset_options(word.ref<std::string>());
  }
  return found;
}

// 0 to N - 1, from replicates = N.
std::vector<AxisValue> replicates(const Axis& axis, const Layers& layers) {
  std::int64_t count = layers.replicates.value_or(0);
  if (!layers.replicates) {
    const toml::node& node = *layers.get(kReplicates);
    if (layers.get(axis.name))
      refuse(fmt::format("{} = N stands for {} = 0 to N - 1: give one of them", kReplicates, axis.name), line_of(node));
    count = node.is_integer() ? node.ref<std::int64_t>() : 0;
    if (count < 1 || count > kMostReplicates)
      refuse(fmt::format("{} is no integer of 1 to {}", kReplicates, kMostReplicates), line_of(node));
  }
  std::vector<AxisValue> values;
  for (std::int64_t i = 0; i < count; ++i) values.emplace_back(i);
  return values;
}

// The values that the keys give an axis; empty where they do not name it.
std::vector<AxisValue> values_of(const Axis& axis, const Layers& layers) {
  if (axis.repeats && (layers.replicates || layers.get(kReplicates))) return replicates(axis, layers);
  const toml::node* node = layers.get(axis.name);
  return node ? AxisReader(axis, *node).values : std::vector<AxisValue>();
}

// Cells of the methods by command line of an [[external]] table.
std::vector<CellOptions> externals(const toml::table& table, const std::string& folder) {
  std::ostringstream json;
  json << toml::json_formatter(table);
  std::vector<CellOptions> cells;
  try {
    for (ExternalTool& tool : external_tools(json.str(), folder)) {
      CellOptions& cell = cells.emplace_back();
      cell.method = tool.name;
      cell.external = std::move(tool);
    }
  } catch (const Error& error) {
    refuse(error.what(), line_of(table));
  }
  return cells;
}

// All combinations, the first axis varying slowest; those that differ only in what does not apply are one.
std::vector<CellOptions> combinations(const Layers& layers, std::vector<CellOptions> cells, long long line) {
  for (CellOptions& cell : cells) cell.budgets = budgets(layers);
  for (const Axis& axis : axes()) {
    if (cells.front().external && axis.name == std::string("method")) continue;
    const std::vector<AxisValue> values = values_of(axis, layers);
    if (values.empty()) continue;
    if (cells.size() * values.size() > kMostCells) refuse(fmt::format("more than {} cells", kMostCells), line);
    std::vector<CellOptions> product;
    for (const CellOptions& cell : cells)
      for (const AxisValue& value : values) {
        product.push_back(cell);
        axis.set(product.back(), value);
      }
    cells = std::move(product);
  }
  return distinct(cells);
}

std::optional<double> weld(const toml::table& file) {
  const toml::node* node = file.get("weld");
  if (!node) return std::nullopt;
  if (node->is_string() && node->ref<std::string>() == "exact") return 0.0;
  const std::optional<double> share = node->is_number() ? node->value<double>() : std::nullopt;
  if (!share || !(*share >= 0.0 && *share <= ReadOptions::kLargestWeld))
    refuse(fmt::format("weld is not \"exact\" or a number of 0 to {}", ReadOptions::kLargestWeld), line_of(*node));
  return share;
}

Repair repair(const toml::table& file) {
  const std::string word = text(file, "repair", repair_name(ReadOptions{}.repair));
  const std::vector<std::string> words = words_of(kRepairs, repair_name);
  if (std::find(words.begin(), words.end(), word) == words.end())
    refuse(fmt::format("repair is none of {}", fmt::join(words, ", ")), line_of(*file.get("repair")));
  return repair_of(word);
}

toml::table parse(const std::string& path) {
  try {
    return toml::parse(read_text(path), path);
  } catch (const toml::parse_error& error) {
    throw Error(Cause::Malformed, std::string(error.description()), Element::Line, error.source().begin.line);
  }
}

// The cells of one block; surfaces that follow each other with the same keys share a RecipeBlock. `start` are the
// methods of an [[external]] table, none for those that the keys name.
void add_block(Recipe& recipe, const toml::table* block, const toml::table& file, long long line,
               const RecipeOverrides& overrides, const std::vector<CellOptions>& start = {}) {
  const ModelList models = model_entries(block, file);
  const auto& instead = overrides.models;
  if (models.entries.empty() && instead.empty())
    refuse(R"(there are no models: models = ["data/*.ply", "shape:torus"])", line);
  const auto surfaces = instead.empty() ? surfaces_of(models.entries) : replacing_surfaces(instead, models.entries);
  std::optional<std::size_t> keys;
  for (const KeyedSurface& surface : surfaces) {
    const Layers layers{surface.keys ? models.own[*surface.keys] : nullptr, block, file, overrides.replicates};
    if (&surface == &surfaces.front() || surface.keys != keys)
      recipe.blocks.push_back({{}, combinations(layers, start.empty() ? presets(layers) : start, line)});
    keys = surface.keys;
    recipe.blocks.back().models.push_back(surface.source);
  }
}

// One spelling for each surface, the first, so that blocks that name it differently mean one model.
void spell_alike(Recipe& recipe) {
  std::map<std::string, std::string> first;
  for (RecipeBlock& block : recipe.blocks)
    for (std::string& source : block.models) source = first.emplace(surface_place(source), source).first->second;
}

void add_externals(Recipe& recipe, const toml::table& file, const std::string& folder,
                   const RecipeOverrides& overrides) {
  std::vector<std::string> keys = external_keys(), names = method_words();
  keys.emplace_back("models");
  for (const toml::table* table : tables(file, "external")) {
    require_known_keys(*table, keys);
    const std::vector<CellOptions> cells = externals(*table, folder);
    for (const CellOptions& cell : cells) {
      if (std::find(names.begin(), names.end(), cell.method) != names.end())
        refuse(fmt::format("there is a method {} already", cell.method), line_of(*table));
      names.push_back(cell.method);
    }
    add_block(recipe, table, file, line_of(*table), overrides, cells);
  }
}

Recipe recipe_of(const toml::table& file, const std::string& path, const RecipeOverrides& overrides) {
  Recipe recipe;
  recipe.name = text(file, "name", std::filesystem::path(path).stem().string());
  recipe.description = text(file, "description", "");
  require_known_keys(file, {"models", "name", "description", "block", "external", "weld", "repair"});
  recipe.read.weld = weld(file);
  recipe.read.repair = repair(file);
  const std::vector<const toml::table*> blocks = tables(file, "block");
  if (blocks.empty()) add_block(recipe, nullptr, file, 1, overrides);
  for (const toml::table* block : blocks) {
    require_known_keys(*block, {"models"});
    add_block(recipe, block, file, line_of(*block), overrides);
  }
  add_externals(recipe, file, std::filesystem::absolute(path).parent_path().string(), overrides);
  return recipe;
}

}  // namespace

Recipe read_recipe(const std::string& path, const RecipeOverrides& overrides) {
  try {
    Recipe recipe = recipe_of(parse(path), path, overrides);
    spell_alike(recipe);
    return recipe;
  } catch (const Error& error) {
    if (error.cause() == Cause::CannotOpen) throw;
    throw error.within(path);
  }
}

}  // namespace gsp
