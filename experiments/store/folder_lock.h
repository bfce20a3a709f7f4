#pragma once

#include <string>

namespace gsp {

/// Held by the one sweep that may write into a store; the system lets it go however the process ends.
class FolderLock {
 public:
  /// Throws Error(CannotWrite) where another process holds it.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  static bool held(const std::string& folder);

 private:
  int file_;
};

}  // namespace gsp
