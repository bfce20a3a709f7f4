#include "mesh/atomic_file.h"

#include <catch2/catch.hpp>

#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "cause_of.h"
#include "mesh/read_file.h"
#include "temporary_folder.h"

using namespace gsp;
namespace fs = std::filesystem;

namespace {

std::atomic<int> synchronized = 0;

void write(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

std::size_t entries(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

}  // namespace

// Counts the calls of this program: the linker takes it in place of the C library's.
extern "C" int fsync(int file) {
  ++synchronized;
  return static_cast<int>(::syscall(SYS_fsync, file));
}

TEST_CASE("threads that write one file leave the whole of one, and nothing beside it") {
  const TemporaryFolder folder;
  const std::string path = folder.file("out.txt");
  std::atomic<int> failures = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<std::thread> writers;
    for (char letter : {'a', 'b', 'c', 'd'})
      writers.emplace_back([&, letter] {
        try {
          write(path, std::string(200'000, letter));
        } catch (const Error&) {
          ++failures;
        }
      });
    for (std::thread& writer : writers) writer.join();
    const std::string text = read_file(path);
    CHECK(text.size() == 200'000);
    CHECK(static_cast<std::size_t>(std::count(text.begin(), text.end(), text[0])) == text.size());
  }
  CHECK(failures == 0);
  CHECK(entries(folder) == 1);
}

TEST_CASE("a file is on the disk before it has its name") {
  const TemporaryFolder folder;
  const int before = synchronized;
  write(folder.file("out.txt"), "x");
  CHECK(synchronized > before);
}

TEST_CASE("a link as output is followed, also where nothing is there yet, and stays a link") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "inside");
  write(folder.file("inside/file.txt"), "old");
  fs::create_symlink("inside/file.txt", folder.path() / "link");
  fs::create_symlink(folder.path() / "link", folder.path() / "second");
  write(folder.file("second"), "new");
  CHECK(fs::is_symlink(folder.path() / "second"));
  CHECK(read_file(folder.file("inside/file.txt")) == "new");
  fs::create_symlink("inside/missing.txt", folder.path() / "dangling");
  write(folder.file("dangling"), "there");
  CHECK(read_file(folder.file("inside/missing.txt")) == "there");
  fs::create_symlink("loop", folder.path() / "loop");
  CHECK(cause_of([&] { write(folder.file("loop"), "x"); }) == Cause::CannotWrite);
}

TEST_CASE("a pipe is written in its place, and a folder is none") {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::string heard;
  std::thread reader([&] {
    std::ifstream in(pipe);
    std::getline(in, heard);
  });
  write(pipe, "told\n");
  reader.join();
  CHECK(heard == "told");
  CHECK(fs::is_fifo(pipe));
  CHECK(cause_of([&] { write(folder.path().string(), "x"); }) == Cause::CannotWrite);
  CHECK(cause_of([] { write("/dev/full", std::string(100'000, 'x')); }) == Cause::CannotWrite);
}

TEST_CASE("a device is written in its place and stays one, also for the one who may replace it") {
  const TemporaryFolder folder;
  const std::string null = folder.file("null");
  if (::mknod(null.c_str(), S_IFCHR | 0600, ::makedev(1, 3)) != 0 || ::access("/dev/null", W_OK) != 0) return;
  if (!std::ofstream(null)) return;  // a file system without devices
  write(null, "nothing\n");
  CHECK(fs::is_character_file(null));
  CHECK(entries(folder) == 1);
}

TEST_CASE("long names are written, and a file keeps its permissions") {
  const TemporaryFolder folder;
  const std::string path = folder.file(std::string(251, 'n') + ".ply");
  write(path, "x");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  write(path, "y");
  CHECK(read_file(path) == "y");
  CHECK(fs::status(path).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("a folder is made with those above it, not where a file is") {
  const TemporaryFolder folder;
  make_folder(folder.file("a/b"));
  make_folder(folder.file("a/b"));
  CHECK(fs::is_directory(folder.file("a/b")));
  write(folder.file("file"), "x");
  CHECK(cause_of([&] { make_folder(folder.file("file")); }) == Cause::CannotWrite);
  CHECK(cause_of([&] { make_folder(folder.file("file/b")); }) == Cause::CannotWrite);
}
