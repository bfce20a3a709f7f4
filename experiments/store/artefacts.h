#pragma once

#include <functional>
#include <string>

namespace gsp {

/// Writes a file of a store through `write(path)` and gives it the name of its content, "artefacts/ab/HASH.ENDING",
/// which is returned relative to the store. It appears whole or not at all. Throws Error(CannotWrite) and what `write`
/// throws.
std::string keep_artefact(const std::string& store, const std::string& ending,
                          const std::function<void(const std::string& path)>& write);

/// False where a file that `keep_artefact` made is missing or no longer what its name says.
bool artefact_intact(const std::string& store, const std::string& path);

/// Removes what writers that were killed left half-written. Only while nothing writes into the store.
void remove_unfinished(const std::string& store);

}  // namespace gsp
