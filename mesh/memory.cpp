#include "mesh/memory.h"

#include <fstream>
#include <string>

namespace gsp {

namespace {

/// The number behind a name in one of Linux' tables, which are in KiB, as bytes.
double bytes_of(const char* table, const std::string& wanted, double otherwise) {
  std::ifstream in(table);
  std::string name, rest;
  double kib = 0.0;
  while (in >> name) {
    if (name == wanted && in >> kib) return 1024.0 * kib;
    std::getline(in, rest);
  }
  return otherwise;
}

}  // namespace

double available_memory() { return bytes_of("/proc/meminfo", "MemAvailable:", 1e18); }

double resident_memory() { return bytes_of("/proc/self/status", "VmRSS:", 0.0); }

}  // namespace gsp
