// SPDX-License-Identifier: Zlib
#include "colliders/planar_normal.h"

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <optional>

#include "test_solids.h"
#include "test_trees.h"

namespace cairn::test::planar_normal_test {
namespace {

using bullet::Contact;
using bullet::PlacedTree;

std::optional<NodeId> leafOfBothSides(const SphereTree& tree) {
  for (std::uint32_t record = 0; record < tree.nodeCount(); ++record) {
    const NodeId node = tree.nodeAt(record);
    if (!tree.isFaceted(node)) continue;
    for (const Vec3& n : tree.faceNormals(node))
      for (const Vec3& m : tree.faceNormals(node))
        if (dot(n, m) < -0.9999F) return node;
  }
  return {};
}

// The two sides of a plate have no edge in common, and nothing is across what is none: whole heaps of angles ended
// nowhere.
TEST(PlanarNormal, OfLeavesThatHoldBothSidesOfAPlateIsNotMadeOfNothing) {
  const auto tree = plainTree(cuboid({1, 1, 0.01}, 3), 2);
  const std::optional<NodeId> leaf = leafOfBothSides(*tree);
  ASSERT_TRUE(leaf);
  const Mat3d upright{{Vec3d(0, 0, -1), Vec3d(0, 1, 0), Vec3d(1, 0, 0)}};
  const PlacedTree lying(*tree, {Mat3d(), Vec3d(), 1}), standing(*tree, {upright, Vec3d(0, 0, 0.4), 1});
  for (const PlacedTree* const a : {&lying, &standing}) {
    Contact contact;
    contact.pair = {*leaf, *leaf};
    contact.normal = normalized(Vec3(1, 0, 1));
#ifdef FE_INVALID  // WebAssembly raises no flags
    std::feclearexcept(FE_INVALID);
#endif
    const Vec3 normal = bullet::PlanarNormal().find(*a, lying, 0, std::array{contact}, {});
    EXPECT_TRUE(isFinite(normal));
#ifdef FE_INVALID
    EXPECT_FALSE(std::fetestexcept(FE_INVALID)) << "nothing was divided by nothing";
#endif
  }
}

}  // namespace
}  // namespace cairn::test::planar_normal_test
