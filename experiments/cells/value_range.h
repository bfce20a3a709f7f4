#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gsp {

/// The numbers of a range, both ends in it: `stride` says what `by` is, "step" (added), "factor" (multiplied by) or
/// "steps" (how many there are). Sums of decimals stand for decimals: 0.1 + 2·0.1 is 0.3. Throws Error(BadOption) where
/// it is empty, never ends, or has more than `most` numbers: a sentence that goes on after "the range of x ".
std::vector<double> range_values(double from, double to, const std::string& stride, double by, std::size_t most);

}  // namespace gsp
