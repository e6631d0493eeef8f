// SPDX-License-Identifier: Zlib
// The pairs tested again during an unfinished traversal take no more memory for any number of contacts.
#include <gtest/gtest.h>

#include "counting_new.h"
#include "pairs/pair_contacts.h"
#include "scripted_traversal.h"

namespace cairn::test::retest_test {
namespace {

using bullet::Contact;

// As many contacts for each leaf pair as it is told, and a traversal that never ends on an empty budget.
class TalkativeCollider final : public bullet::Collider {
 public:
  int perPair = 1;

  void place(const bullet::PairPlacement& /*placement*/) override {}
  void start(std::vector<NodePair>& /*known*/, float /*skin*/) override { traversal_.restart(); }
  bool resume() override { return true; }
  Traversal& traversal() override { return traversal_; }
  using Collider::appendContacts;
  void appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) override {
    for (const NodePair& pair : pairs)
      for (int i = 0; i < perPair; ++i) contacts.push_back(contact(pair, i));
  }
  Contact boundingContact(const NodePair& pair) override {
    Contact sphere = contact(pair, 0);
    sphere.ofSpheres = true;
    return sphere;
  }
  float size(const btCollisionShape& /*shape*/) const override { return 1; }

  static Contact contact(const NodePair& pair, int place) {
    Contact contact;
    contact.normal = Vec3(0, 0, 1);
    contact.separation = -0.01F;
    contact.pair = pair;
    contact.id = {0, static_cast<int>(pair.a), 0, place};
    return contact;
  }

 private:
  std::vector<int> log_;
  ScriptedTraversal traversal_{0, {1, 1}, log_};
};

// Steps of a pair that never gets a budget, and knows as many leaf pairs as it may.
void step(bullet::PairContacts& pair, TalkativeCollider& collider, bullet::ContactScratch& scratch) {
  bullet::RelativeMotion motion;
  motion.smallerSize = 1;
  motion.maxSeparation = motion.reported = 0.002F;
  Budget budget = Budget::operations(0);
  pair.begin(collider, motion, {}, budget, scratch);
  pair.finish(collider, {.unresolved = bullet::Unresolved::guard}, motion, motion.maxSeparation, {}, budget, scratch);
  for (std::uint32_t i = 0; i < bullet::KnownPairs::kMax; ++i) pair.known().remember(NodePair{i, 0});
}

TEST(Retests, TakeNoMoreMemoryHoweverMuchIsSaid) {
  if (!countsAllocations()) GTEST_SKIP() << "the sanitizer owns new";
  TalkativeCollider collider;
  bullet::ContactScratch scratch;
  bullet::PairContacts first, second;
  // More than one each: a pair makes all its room when it first needs some.
  collider.perPair = 2;
  for (int i = 0; i < 4; ++i) step(second, collider, scratch);
  // The memory that pairs share has grown to its final size by then.
  collider.perPair = 60;
  for (int i = 0; i < 4; ++i) step(first, collider, scratch);
  const std::size_t before = allocations();
  for (int i = 0; i < 4; ++i) step(second, collider, scratch);
  EXPECT_EQ(allocations() - before, 0U);
}

}  // namespace
}  // namespace cairn::test::retest_test
