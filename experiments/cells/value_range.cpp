#include "experiments/cells/value_range.h"

#include <fmt/format.h>

#include <cmath>

#include "mesh/error.h"

namespace gsp {

std::vector<double> range_values(double from, double to, const std::string& stride, double by, std::size_t most) {
  if (to < from) throw Error(Cause::BadOption, fmt::format("is empty: {} to {}", from, to));
  const bool steps = stride == "steps", step = stride == "step";
  if (steps && (!(by >= 2.0 && by <= static_cast<double>(most)) || by != std::floor(by)))
    throw Error(Cause::BadOption, fmt::format("has steps that are no integer of 2 to {}", most));
  if (!steps && (step ? !(by > 0.0) : !(by > 1.0 && from > 0.0))) throw Error(Cause::BadOption, "never ends");
  std::vector<double> values;
  for (int i = 0;; ++i) {
    const double x = steps ? from + i * (to - from) / (by - 1.0) : step ? from + i * by : from * std::pow(by, i);
    // Some slack, so that 0 to 1 by 0.1 ends at 1.
    if (steps ? i >= by : x > to + 1e-9 * std::abs(to)) return values;
    values.push_back(std::stod(fmt::format("{:.12g}", x)));
    if (values.size() > most) throw Error(Cause::BadOption, fmt::format("has more than {} values", most));
  }
}

}  // namespace gsp
