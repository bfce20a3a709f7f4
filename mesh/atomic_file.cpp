#include "mesh/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <unistd.h>

#include "mesh/error.h"

namespace gsp {

namespace {
[[noreturn]] void fail(const std::string& path) {
  throw Error(Cause::CannotWrite, "cannot write " + path + ": " + std::strerror(errno));
}
}  // namespace

AtomicFile::AtomicFile(const std::string& path)
    : path_(path), temporary_(path + ".part-" + std::to_string(::getpid())) {
  out_.open(temporary_, std::ios::binary);
  if (!out_) fail(path_);
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  out_.close();
  std::remove(temporary_.c_str());
}

void AtomicFile::commit() {
  out_.close();
  if (!out_ || std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_);
  temporary_.clear();
}

}  // namespace gsp
