#include "mesh/memory.h"

#include <sys/resource.h>

#include <fstream>
#include <optional>
#include <string>

namespace gsp {

namespace {

constexpr double kKibibyte = 1024.0;

/// The number behind a name in one of Linux' tables, which are in KiB, as bytes; nothing where it is not there.
std::optional<double> bytes_of(const char* table, const std::string& wanted) {
  std::ifstream in(table);
  std::string name, rest;
  double kib = 0.0;
  while (in >> name) {
    if (name == wanted && in >> kib) return kKibibyte * kib;
    std::getline(in, rest);
  }
  return std::nullopt;
}

}  // namespace

double available_memory() { return bytes_of("/proc/meminfo", "MemAvailable:").value_or(1e18); }

double peak_memory() {
  if (const auto bytes = bytes_of("/proc/self/status", "VmHWM:")) return *bytes;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return kKibibyte * static_cast<double>(usage.ru_maxrss);
}

double resident_memory() { return bytes_of("/proc/self/status", "VmRSS:").value_or(0.0); }

}  // namespace gsp
