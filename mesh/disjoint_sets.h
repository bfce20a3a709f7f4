#pragma once

#include <numeric>
#include <utility>
#include <vector>

namespace gsp {

/// Union-find whose root is the set's smallest member, so that results do not depend on the order of unions. Each
/// member has a sign relative to its root, for two-colourings such as "which faces to turn".
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count), odd_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int root(int x) {
    compress(x);
    return parent_[x];
  }
  /// Whether x and its root differ in sign.
  bool odd(int x) {
    compress(x);
    return odd_[x] != 0;
  }
  /// Joins the sets of x and y, which differ in sign if `differ`. False where that contradicts what is known.
  bool unite(int x, int y, bool differ = false) {
    int a = root(x), b = root(y);
    const bool sign = (odd_[x] != odd_[y]) != differ;
    if (a == b) return !sign;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    odd_[b] = sign;
    return true;
  }

 private:
  void compress(int x) {
    // To the root once for the sign, once more to hang everything passed directly under it.
    int root = x;
    unsigned char sign = 0;
    for (; parent_[root] != root; root = parent_[root]) sign ^= odd_[root];
    while (parent_[x] != root && x != root) {
      const int next = parent_[x];
      const unsigned char own = odd_[x];
      parent_[x] = root;
      odd_[x] = sign;
      sign ^= own;
      x = next;
    }
  }

  std::vector<int> parent_;
  std::vector<unsigned char> odd_;
};

}  // namespace gsp
