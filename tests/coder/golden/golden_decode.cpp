#include <cstdio>
#include <fstream>
#include <string>

#include "mesh/error.h"
#include "tests/coder/golden/golden.h"

/// golden_decode FOLDER: exit status 1 where a stream named in FOLDER/hashes.txt decodes to other bits than are kept
/// there. It is built in several ways, which must agree (CMakeLists.txt).
int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::string folder = std::string(arguments[1]) + "/";
  std::ifstream kept(folder + "hashes.txt");
  std::string name;
  unsigned long long whole, half;
  int streams = 0, differ = 0;
  while (kept >> name >> std::hex >> whole >> half) {
    ++streams;
    try {
      const auto found = gsp::golden::hashes(gsp::golden::read(folder + name));
      if (found[0] == whole && found[1] == half) continue;
      std::printf("%s decodes to %016llx %016llx\n", name.c_str(), static_cast<unsigned long long>(found[0]),
                  static_cast<unsigned long long>(found[1]));
    } catch (const gsp::Error& error) {
      std::printf("%s: %s\n", name.c_str(), error.what());
    }
    ++differ;
  }
  return streams == 0 || differ > 0;
}
