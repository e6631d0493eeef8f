// SPDX-License-Identifier: Zlib
#include "pairs/found_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "counting_new.h"
#include "random_tree.h"

namespace cairn::test::found_pairs_test {
namespace {

using bullet::Contact;
using bullet::FoundPairs;

// Pairs have several contacts each, told in several steps: those with the deepest are kept, once each.
TEST(FoundPairs, KeepTheDeepest) {
  for (int seed = 1; seed <= 50; ++seed) {
    std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
    FoundPairs found;
    found.makeRoom();
    std::map<NodeId, float> deepest;  // of all that was told
    std::size_t allocated = 0;
    for (int step = 0; step < 5; ++step) {
      std::vector<Contact> contacts(static_cast<std::size_t>(uniform(engine, 0, 60)));
      for (Contact& contact : contacts) {
        contact.pair = {static_cast<NodeId>(uniform(engine, 0, 80)), 7};
        contact.separation = static_cast<float>(uniform(engine, -1, 0.1));
        const auto [at, isNew] = deepest.try_emplace(contact.pair.a, contact.separation);
        at->second = std::min(at->second, contact.separation);
      }
      const std::size_t now = allocations();
      found.add(contacts);
      allocated += allocations() - now;
    }
    EXPECT_EQ(allocated, 0U) << "seed " << seed;
    std::vector<std::pair<float, NodeId>> wanted;
    for (const auto& [node, separation] : deepest) wanted.emplace_back(separation, node);
    std::ranges::sort(wanted);
    wanted.resize(std::min(wanted.size(), FoundPairs::kMax));
    std::vector<NodeId> expected, kept;
    for (const auto& [separation, node] : wanted) expected.push_back(node);
    for (const NodePair& pair : found.pairs()) kept.push_back(pair.a);
    std::ranges::sort(expected);
    std::ranges::sort(kept);
    EXPECT_EQ(kept, expected) << "seed " << seed;
    found.clear();
    EXPECT_TRUE(found.pairs().empty());
  }
}

}  // namespace
}  // namespace cairn::test::found_pairs_test
