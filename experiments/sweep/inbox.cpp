#include "experiments/sweep/inbox.h"

#include <filesystem>

#include "experiments/sweep/task.h"

namespace gsp {

namespace fs = std::filesystem;

std::vector<StageResult> empty_inbox(Store& store) {
  std::vector<StageResult> results;
  std::vector<fs::path> taken;
  const std::string folder = inbox_folder(store.folder());
  if (!fs::is_directory(folder)) return results;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    try {
      results.push_back(read_result(entry.path().string()));
    } catch (const Error& error) {
      if (error.cause() != Cause::Malformed) throw;
    }
    taken.push_back(entry.path());
  }
  if (!results.empty()) store.put(results);
  for (const fs::path& path : taken) fs::remove(path);
  return results;
}

}  // namespace gsp
