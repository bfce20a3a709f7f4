#include "experiments/sweep/plan.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "experiments/cells/models.h"
#include "experiments/store/content_hash.h"
#include "experiments/sweep/algorithm_version.h"
#include "experiments/sweep/external_version.h"

namespace gsp {

namespace {

std::string budget_text(const CellOptions& options) {
  std::string text;
  for (std::size_t bytes : options.budgets) text += (text.empty() ? "budgets=" : ",") + std::to_string(bytes);
  return text;
}

// The method and, of the options, those that vary between the cells of that method on some model. What differs from
// model to model only, as a base size for each, tells no two curves of a model apart, and curves compare by label.
class Labels {
 public:
  explicit Labels(const Recipe& recipe) {
    std::map<std::tuple<std::string, std::string, std::string>, std::set<std::string>> values;
    for (const RecipeBlock& block : recipe.blocks)
      for (const std::string& model : block.models)
        for (const CellOptions& cell : block.cells) {
          const auto add = [&](const std::string& option, const std::string& value) {
            std::set<std::string>& found = values[{model, cell.method, option}];
            found.insert(value);
            if (found.size() > 1) varying_.insert({cell.method, option});
          };
          for (const Axis& axis : axes())
            if (!axis.repeats) add(axis.name, to_string(axis.get(cell)));
          add("budgets", budget_text(cell));
        }
  }

  std::string of(const CellOptions& options) const {
    std::string label = options.method;
    for (const Axis& axis : axes())
      if (varying_.count({options.method, axis.name}))
        label += ' ' + std::string(axis.name) + '=' + to_string(axis.get(options));
    if (varying_.count({options.method, "budgets"})) label += ' ' + budget_text(options);
    return label;
  }

 private:
  std::set<std::pair<std::string, std::string>> varying_;  ///< method and option
};

std::map<StageKind, std::string> stage_keys(const CellOptions& options, const std::string& surface) {
  std::map<StageKind, std::string> keys;
  std::string input = surface;
  for (StageKind kind : stages_of(options)) input = keys[kind] = stage_key(kind, options, input);
  return keys;
}

StoredModel stored_model(const ModelSource& source, const ReadOptions& read,
                         const std::function<void(const std::string& key, const Mesh&)>& keep,
                         std::vector<std::string>& notes) {
  StoredModel model;
  model.name = source.name;
  model.source = source.source;
  try {
    const SurfaceFile file = read_model(source.source, read);
    const Mesh& mesh = file.mesh;
    for (const std::string& note : file.notes) notes.push_back(source.name + ": " + note);
    model.surface_key = mesh_hash(mesh);
    model.path = surface_path(model.surface_key);
    model.vertices = mesh.vertex_count();
    model.faces = mesh.face_count();
    keep(model.surface_key, mesh);
  } catch (const Error& error) {
    if (error.cause() == Cause::CannotWrite) throw;
    model.cause = cause_name(error.cause());
    model.failure = error.what();
  }
  return model;
}

}  // namespace

std::string surface_path(const std::string& key) { return "artefacts/" + key.substr(0, 2) + '/' + key + ".ply"; }

std::string stage_key(StageKind kind, const CellOptions& options, const std::string& input) {
  std::string text = "gsp stage 1";
  for (const std::string& part :
       {std::string(stage_name(kind)), std::string(algorithm_version(kind)), options_json(options, kind), input})
    text += '\n' + part;
  return content_hash(text);
}

Plan make_plan(const Recipe& of_file, const std::function<void(const std::string& key, const Mesh&)>& keep) {
  const Recipe recipe = with_external_versions(of_file);
  Plan plan;
  plan.recipe = recipe.name;
  std::vector<std::string> sources;
  for (const RecipeBlock& block : recipe.blocks)
    for (const std::string& source : block.models)
      if (std::find(sources.begin(), sources.end(), source) == sources.end()) sources.push_back(source);
  for (const ModelSource& source : named_models(sources))
    plan.models.push_back(stored_model(source, recipe.read, keep, plan.notes));

  const Labels labels(recipe);
  std::set<std::string> seen;
  for (const StoredModel& model : plan.models)
    for (const RecipeBlock& block : recipe.blocks) {
      if (std::find(block.models.begin(), block.models.end(), model.source) == block.models.end()) continue;
      for (const CellOptions& options : block.cells) {
        if (!seen.insert(model.name + '\n' + options_json(options)).second) continue;
        PlannedCell cell{model.name, labels.of(options), options, {}};
        if (model.cause.empty()) cell.keys = stage_keys(options, model.surface_key);
        plan.cells.push_back(std::move(cell));
      }
    }
  return plan;
}

}  // namespace gsp
