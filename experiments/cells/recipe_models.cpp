#include "experiments/cells/recipe_models.h"

#include <fnmatch.h>

#include <algorithm>
#include <filesystem>

#include "experiments/cells/models.h"
#include "mesh/error.h"

namespace gsp {

namespace {

void add_surface(std::vector<KeyedSurface>& surfaces, KeyedSurface surface, long long line) {
  const auto same = std::find_if(surfaces.begin(), surfaces.end(), [&](const KeyedSurface& other) {
    return surface_place(other.source) == surface_place(surface.source);
  });
  if (same == surfaces.end()) {
    surfaces.push_back(std::move(surface));
  } else if (surface.keys) {
    if (same->keys && same->keys != surface.keys)
      throw Error(Cause::BadOption, surface.source + " has keys twice; a key takes a list of values", Element::Line,
                  line);
    same->keys = surface.keys;
  }
}

std::string stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

}  // namespace

std::vector<KeyedSurface> surfaces_of(const std::vector<ModelEntry>& entries) {
  std::vector<KeyedSurface> surfaces;
  for (std::size_t i = 0; i < entries.size(); ++i) try {
      const auto keys = entries[i].has_keys ? std::optional(i) : std::nullopt;
      for (std::string& source : matching_models(entries[i].pattern))
        add_surface(surfaces, {std::move(source), keys}, entries[i].line);
    } catch (const Error& error) {
      const bool unfound = error.cause() == Cause::CannotOpen;
      throw Error(Cause::BadOption, std::string(error.what()) + (unfound ? "; --models takes other surfaces" : ""),
                  Element::Line, entries[i].line);
    }
  return surfaces;
}

std::vector<KeyedSurface> replacing_surfaces(const std::vector<std::string>& instead,
                                             const std::vector<ModelEntry>& entries) {
  std::vector<KeyedSurface> surfaces;
  for (const std::string& pattern : instead)
    for (const std::string& source : matching_models(pattern)) {
      const auto entry = std::find_if(entries.begin(), entries.end(), [&](const ModelEntry& e) {
        return e.has_keys && ::fnmatch(stem(e.pattern).c_str(), stem(source).c_str(), 0) == 0;
      });
      // The same surface has the same entry, however often it is given.
      const bool known = entry != entries.end();
      add_surface(surfaces,
                  {source, known ? std::optional(static_cast<std::size_t>(entry - entries.begin())) : std::nullopt},
                  known ? entry->line : 0);
    }
  return surfaces;
}

}  // namespace gsp
