#include "experiments/store/artefacts.h"

#include <unistd.h>

#include <filesystem>
#include <vector>

#include "experiments/store/content_hash.h"
#include "mesh/error.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;
constexpr const char* kIncoming = "incoming-";

}  // namespace

std::string keep_artefact(const std::string& store, const std::string& ending,
                          const std::function<void(const std::string& path)>& write) {
  const std::string temporary =
      store + "/artefacts/" + kIncoming + std::to_string(::getpid()) + '-' + std::to_string(::gettid()) + ending;
  write(temporary);
  const std::string hash = file_hash(temporary);
  const std::string path = "artefacts/" + hash.substr(0, 2) + '/' + hash + ending;
  std::error_code failed;
  fs::create_directories(fs::path(store + '/' + path).parent_path(), failed);
  if (!failed) fs::rename(temporary, store + '/' + path, failed);
  if (failed) throw Error(Cause::CannotWrite, "cannot write " + store + '/' + path + ": " + failed.message());
  return path;
}

bool artefact_intact(const std::string& store, const std::string& path) {
  try {
    const std::string name = fs::path(path).filename().string();
    return file_hash(store + '/' + path) == name.substr(0, name.find('.'));
  } catch (const Error&) {
    return false;
  }
}

void remove_unfinished(const std::string& store) {
  std::vector<fs::path> unfinished;
  for (const char* folder : {"/artefacts", "/inbox", "/tasks"}) {
    if (!fs::is_directory(store + folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(store + folder)) {
      const std::string name = entry.path().filename().string();
      if (name.rfind(kIncoming, 0) == 0 || name.find(".part-") != std::string::npos) unfinished.push_back(entry.path());
    }
  }
  std::error_code ignored;
  for (const fs::path& path : unfinished) fs::remove(path, ignored);
  fs::remove_all(store + "/scratch", ignored);  // of external methods that were interrupted
}

}  // namespace gsp
