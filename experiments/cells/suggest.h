#pragma once

#include <string>
#include <vector>

namespace gsp {

/// Fewest insertions, deletions, substitutions and swaps of neighbours that turn one word into the other.
/// O(product of the lengths).
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to a mistyped word, empty where none is near enough to be meant.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace gsp
