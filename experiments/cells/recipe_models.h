#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gsp {

/// One entry of a recipe's `models`: a pattern of surfaces (`matching_models`), which may have keys for these alone.
struct ModelEntry {
  std::string pattern;
  bool has_keys;
  long long line;  ///< of the recipe
};

struct KeyedSurface {
  std::string source;
  std::optional<std::size_t> keys;  ///< the entry whose keys it has; none for those of the recipe
};

/// The surfaces that entries name, in order. One that is named twice is one, with the keys of the entry that has some.
/// Throws Error(BadOption) with the entry's line where nothing matches, or a surface has keys twice.
std::vector<KeyedSurface> surfaces_of(const std::vector<ModelEntry>& entries);

/// The surfaces that patterns name instead. One whose file is called as an entry with keys says has that entry's keys.
/// Throws the errors of `matching_models`.
std::vector<KeyedSurface> replacing_surfaces(const std::vector<std::string>& instead,
                                             const std::vector<ModelEntry>& entries);

}  // namespace gsp
