#include "experiments/store/folder_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "mesh/error.h"

namespace gsp {

namespace {

// A lock of the whole file that belongs to its description, not to the process: threads of one exclude each other too,
// and it ends with the last descriptor.
struct flock whole_file() {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

FolderLock::FolderLock(const std::string& folder)
    : file_(::open((folder + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (file_ < 0) throw Error(Cause::CannotWrite, "cannot write " + folder + "/lock: " + std::strerror(errno));
  struct flock lock = whole_file();
  if (::fcntl(file_, F_OFD_SETLK, &lock) == 0) return;
  ::close(file_);
  throw Error(Cause::CannotWrite, "another sweep is at work on " + folder);
}

FolderLock::~FolderLock() { ::close(file_); }

bool FolderLock::held(const std::string& folder) {
  const int file = ::open((folder + "/lock").c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  // Asks without taking it, which would turn away a sweep that begins in this moment.
  struct flock lock = whole_file();
  const bool held = ::fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(file);
  return held;
}

}  // namespace gsp
