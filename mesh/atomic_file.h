#pragma once

#include <fstream>
#include <string>
#include <string_view>

namespace gsp {

/// An output file that appears whole or not at all: bytes go to a temporary beside it, `commit` brings them to the disk
/// and renames it. Without `commit` the temporary is removed. Any number of threads and processes may write one path;
/// the last one that commits counts. A link is followed: what it leads to is written, and the link stays. What is no
/// file, such as a device or a pipe, is written in its place. A file that was there keeps its permissions. Throws
/// Error(CannotWrite) with the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return out_; }
  void commit();

 private:
  std::string target_;
  std::string temporary_;  ///< empty where the target is written in its place
  std::ofstream out_;
};

/// A whole file in one call.
void write_file(const std::string& path, std::string_view bytes);

/// Makes a folder and those above it, where they are not there. Throws Error(CannotWrite) with the system's reason,
/// also where a file is in its place.
void make_folder(const std::string& path);

}  // namespace gsp
