// SPDX-License-Identifier: Zlib
#include "contacts/reduction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "contacts/normal_clusters.h"
#include "random_tree.h"

namespace cairn::test::reduction_test {
namespace {

using namespace cairn::bullet;

constexpr float kReach = 0.004F, kSeparation = 0.006F;

Contact contactAt(const Vec3& position, float separation, int id, const Vec3& normal = {0, 0, 1}) {
  Contact c;
  c.position = position;
  c.separation = separation;
  c.normal = normal;
  c.id.treeIndex = id;
  return c;
}

std::vector<Contact> randomPatch(std::mt19937_64& engine, int count) {
  std::vector<Contact> patch;
  for (int i = 0; i < count; ++i)
    patch.push_back(contactAt({float(uniform(engine, -1, 1)), float(uniform(engine, -1, 1)), 0},
                              float(uniform(engine, -0.01, 0.003)), i));
  std::sort(patch.begin(), patch.end(), deeper);
  return patch;
}

float areaOf(const std::vector<Vec3>& p) {  // of the hull of up to four points in z = 0: the best of all orders
  std::vector<int> order(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) order[i] = static_cast<int>(i);
  float best = 0;
  do {
    float twice = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Vec3& a = p[static_cast<std::size_t>(order[i])];
      const Vec3& b = p[static_cast<std::size_t>(order[(i + 1) % order.size()])];
      twice += a.x * b.y - a.y * b.x;
    }
    best = std::max(best, twice / 2);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(Reduction_Choice, HoldsTheDeepestAndMostOfTheArea) {
  std::mt19937_64 engine(12);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Contact> patch = randomPatch(engine, 12);
    const std::vector<Contact> before = patch;
    const std::span<const Contact> choice = chooseContacts(patch, {}, kSeparation, kReach);
    ASSERT_EQ(choice.size(), std::size_t{kMaxPoints});
    EXPECT_EQ(choice.data(), patch.data());
    EXPECT_EQ(choice[0].id, before[0].id) << "the deepest";
    EXPECT_TRUE(std::ranges::is_permutation(patch, before, {}, &Contact::id, &Contact::id));
    std::vector<Vec3> chosen;
    for (const Contact& c : choice) chosen.push_back(c.position);
    float best = 0;  // over all quadruples that hold the deepest
    for (std::size_t i = 1; i < patch.size(); ++i)
      for (std::size_t j = i + 1; j < patch.size(); ++j)
        for (std::size_t k = j + 1; k < patch.size(); ++k)
          best = std::max(best, areaOf({patch[0].position, patch[i].position, patch[j].position, patch[k].position}));
    // Greedy by distance, triangle and gain reaches half of the best quadruple at least (the farthest point halves
    // nothing).
    EXPECT_GT(areaOf(chosen), 0.5F * best) << "seed 12, trial " << trial;
  }
}

TEST(Reduction_Choice, NeverTakesTwoPointsForOne) {
  std::mt19937_64 engine(13);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Contact> patch = randomPatch(engine, 10);
    for (Contact& c : patch) c.position = c.position * 0.005F;  // all within about one separation
    const std::span<const Contact> choice = chooseContacts(patch, {}, kSeparation, kReach);
    ASSERT_GE(choice.size(), 1U);
    for (std::size_t i = 0; i < choice.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) EXPECT_GE(distance(choice[i].position, choice[j].position), kSeparation);
  }
}

std::set<int> idsOf(std::span<const Contact> chosen) {
  std::set<int> ids;
  for (const Contact& contact : chosen) ids.insert(contact.id.treeIndex);
  return ids;
}

// How often the choice changes while the gaps tremble by a tenth of the speculative distance, with and without memory.
int changes(std::uint64_t seed, bool remembers) {
  std::mt19937_64 engine(seed);
  int count = 0;
  const std::vector<Contact> still = randomPatch(engine, 20);
  std::set<int> last;
  for (int step = 0; step < 60; ++step) {
    std::vector<Contact> patch = still;
    for (Contact& c : patch) c.separation = -0.001F + float(uniform(engine, -2e-4, 2e-4));
    std::sort(patch.begin(), patch.end(), deeper);
    std::vector<ContactId> held;
    for (const int id : last) held.push_back(contactAt({}, 0, id).id);
    const std::set<int> now = idsOf(chooseContacts(
        patch, remembers ? std::span<const ContactId>(held) : std::span<const ContactId>(), kSeparation, kReach));
    count += step > 10 && now != last;  // the first steps settle
    last = now;
  }
  return count;
}

TEST(Reduction_Hysteresis, TremblingGapsChangeTheChoiceFarLessOften) {
  int with = 0, without = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    with += changes(seed, true);
    without += changes(seed, false);
  }
  EXPECT_GT(without, 1000) << "the patches are too easy to show anything";
  EXPECT_LT(with, without / 10);
}

TEST(Clusters_Group, KeepsMembersNearTheirSeedAndLosesNobody) {
  std::mt19937_64 engine(15);
  ClusterSeeds seeds{};
  ClusteredContacts contacts;
  for (int trial = 0; trial < 100; ++trial) {
    contacts.list().clear();
    const auto count = static_cast<int>(engine() % 40);
    for (int i = 0; i < count; ++i)
      contacts.list().push_back(contactAt(Vec3(randomPoint(engine)), float(uniform(engine, -0.01, 0.0039)), i,
                                          Vec3(normalized(randomPoint(engine)))));
    contacts.group(seeds, kReach);
    std::set<int> seen;
    for (int k = 0; k < kMaxClusters; ++k) {
      const auto members = contacts.cluster(k);
      EXPECT_EQ(!members.empty(), seeds[static_cast<std::size_t>(k)].active);
      EXPECT_TRUE(std::is_sorted(members.begin(), members.end(), deeper));
      for (const Contact& c : members) seen.insert(c.id.treeIndex);
    }
    EXPECT_EQ(static_cast<int>(seen.size()), count) << "seed 15, trial " << trial;
  }
}

TEST(Clusters_Group, KeepsItsClusterFromStepToStep) {
  ClusterSeeds seeds{};
  ClusteredContacts contacts;
  const Vec3 up{0, 0, 1}, right{1, 0, 0};
  contacts.list() = {contactAt({0, 0, 0}, -0.002F, 1, up), contactAt({1, 0, 0}, -0.001F, 2, right)};
  contacts.group(seeds, kReach);
  ASSERT_EQ(contacts.cluster(0).size(), 1U);
  EXPECT_EQ(contacts.cluster(0)[0].id.treeIndex, 1);
  // The other becomes the deeper one: both stay where they are.
  contacts.list() = {contactAt({0, 0, 0}, -0.001F, 1, up), contactAt({1, 0, 0}, -0.002F, 2, right)};
  contacts.group(seeds, kReach);
  EXPECT_EQ(contacts.cluster(0)[0].id.treeIndex, 1);
  EXPECT_EQ(contacts.cluster(1)[0].id.treeIndex, 2);
}

}  // namespace
}  // namespace cairn::test::reduction_test
