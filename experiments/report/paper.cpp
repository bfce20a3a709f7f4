#include "experiments/report/paper.h"

#include <algorithm>
#include <cctype>

namespace gsp {

std::optional<double> paper_remesh_error(const std::string& model) {
  struct Row {
    const char* name;
    double error;
  };
  constexpr Row kTable1[] = {{"venus", 3.55e-5}, {"david", 22.50e-5}, {"rabbit", 3.68e-5},
                             {"bunny", 4.22e-5}, {"horse", 5.16e-5},  {"feline", 3.54e-5}};
  std::string lower = model;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const Row& row : kTable1)
    if (lower.find(row.name) != std::string::npos) return row.error;
  return std::nullopt;
}

}  // namespace gsp
