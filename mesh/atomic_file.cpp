#include "mesh/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "mesh/error.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int reason = errno) {
  throw Error(Cause::CannotWrite, "cannot write " + path + ": " + std::strerror(reason));
}

/// Where a chain of links leads, also where nothing is there yet.
std::string followed(const std::string& path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  fs::path place = path;
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code no_link;
    const fs::path next = fs::read_symlink(place, no_link);
    if (no_link) return place.string();
    place = place.parent_path() / next;
  }
  fail(path, ELOOP);
}

bool is_device(const std::string& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// Makes a new file beside the target, of a name that no other writer has.
std::string make_temporary(const std::string& target) {
  static std::atomic<unsigned> count = 0;
  constexpr std::size_t kMostBytes = 200;  // of the target's name, so that the whole is no longer than a name may be
  const fs::path place = target;
  const std::string stem = (place.parent_path() / place.filename().string().substr(0, kMostBytes)).string();
  for (;;) {
    const std::string name = stem + ".part-" + std::to_string(::getpid()) + '-' + std::to_string(count++);
    const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) {
      ::close(file);
      return name;
    }
    if (errno != EEXIST) fail(target);
  }
}

/// Brings the file's bytes to the disk, so that no power failure leaves the new name with less than all of them.
bool synchronize(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = ::fsync(file) == 0;
  ::close(file);
  return done;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : target_(path) {
  if (!is_device(path)) {
    target_ = followed(path);
    temporary_ = make_temporary(target_);
  }
  out_.open(temporary_.empty() ? target_ : temporary_, std::ios::binary);
  if (!out_) fail(target_);
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  out_.close();
  std::remove(temporary_.c_str());
}

void AtomicFile::commit() {
  out_.close();
  if (!out_) fail(target_);
  if (temporary_.empty()) return;
  std::error_code ignored;
  const fs::file_status before = fs::status(target_, ignored);
  if (fs::is_regular_file(before)) fs::permissions(temporary_, before.permissions(), ignored);
  if (!synchronize(temporary_) || std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(target_);
  temporary_.clear();
  // The folder holds the new name; where it cannot be brought to the disk, the old content may come back, whole.
  const std::string folder = fs::path(target_).parent_path().string();
  synchronize(folder.empty() ? "." : folder);
}

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

void make_folder(const std::string& path) {
  std::error_code failed;
  fs::create_directories(path, failed);
  if (!failed && !fs::is_directory(path)) failed = std::make_error_code(std::errc::not_a_directory);
  if (failed) throw Error(Cause::CannotWrite, "cannot make the folder " + path + ": " + failed.message());
}

}  // namespace gsp
