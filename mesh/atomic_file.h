#pragma once

#include <fstream>
#include <string>

namespace gsp {

/// An output file that appears whole or not at all: bytes go to a temporary beside it, `commit` flushes and renames it.
/// Without `commit` the temporary is removed. Throws Error(CannotWrite) with the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return out_; }
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  std::ofstream out_;
};

}  // namespace gsp
