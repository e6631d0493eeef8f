// SPDX-License-Identifier: Zlib
#include "cairn/core/rank_heap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace cairn::rank_heap_test {
namespace {

std::size_t firstOf(const std::map<std::size_t, RankHeap::Entry>& entries) {
  return std::min_element(entries.begin(), entries.end(),
                          [](const auto& l, const auto& r) {
                            const RankHeap::Entry &a = l.second, &b = r.second;
                            return a.rank != b.rank ? a.rank > b.rank : a.ticket < b.ticket;
                          })
      ->first;
}

TEST(RankHeap, TopIsTheFirstByBruteForce_WhateverHappens) {
  std::mt19937_64 engine(1);
  RankHeap heap;
  for (const std::size_t count : {1U, 2U, 3U, 17U, 100U}) {
    std::map<std::size_t, RankHeap::Entry> entries;
    std::uint64_t ticket = 0;
    heap.start(count);
    for (std::size_t pair = 0; pair < count; ++pair) {
      entries[pair] = {static_cast<double>(engine() % 10), ticket++, pair};  // few ranks: many ties
      heap.add(entries[pair]);
    }
    while (!entries.empty()) {
      ASSERT_EQ(heap.top(), firstOf(entries));
      const auto chosen = std::next(entries.begin(), static_cast<std::ptrdiff_t>(engine() % entries.size()));
      if (engine() % 4 == 0) {
        heap.remove(chosen->first);
        entries.erase(chosen);
      } else {
        chosen->second = {static_cast<double>(engine() % 10), ticket++, chosen->first};
        heap.change(chosen->second);
      }
    }
    EXPECT_TRUE(heap.empty());
  }
}

}  // namespace
}  // namespace cairn::rank_heap_test
