#include "coder/due_list.h"

#include <catch2/catch.hpp>
#include <map>

#include "mesh/random.h"

using namespace gsp;

TEST_CASE("a due list visits what is due, in order, and nothing else") {
  constexpr int kSize = 333;
  Random random(4);
  DueList list(kSize);
  std::map<int, DueList::Pass> expected;
  for (int pass = 255; pass > DueList::kNever; --pass) {
    for (int k = 0; k < 40; ++k) {
      const int i = static_cast<int>(random.next() % kSize);
      const auto due = static_cast<DueList::Pass>(random.next() % 256);
      list.set(i, due);
      expected[i] = due;
    }
    const int begin = static_cast<int>(random.next() % kSize),
              end = begin + static_cast<int>(random.next() % (kSize - begin + 1));
    std::vector<int> due, visited;
    for (const auto& [i, when] : expected)
      if (i >= begin && i < end && when >= pass) due.push_back(i);
    list.for_each_due(begin, end, static_cast<DueList::Pass>(pass), [&](int i) {
      visited.push_back(i);
      return DueList::kNever;
    });
    for (int i : due) expected[i] = DueList::kNever;
    REQUIRE(visited == due);
  }
}

TEST_CASE("what is put off in a visit comes back in its pass") {
  DueList list(64);
  for (int i = 0; i < 64; ++i) list.set(i, static_cast<DueList::Pass>(i + 1));
  std::vector<int> visits(64, 0);
  for (int pass = 100; pass > 0; --pass)
    list.for_each_due(0, 64, static_cast<DueList::Pass>(pass), [&](int i) {
      CHECK(list[i] == pass);
      ++visits[i];
      return static_cast<DueList::Pass>(pass / 2);
    });
  // From i + 1, halved until nothing is left.
  for (int i = 0; i < 64; ++i) CHECK(visits[i] == static_cast<int>(std::bit_width(static_cast<unsigned>(i + 1))));
}
