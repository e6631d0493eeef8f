// SPDX-License-Identifier: GPL-3.0-or-later
// A body in a slot of a large leaf touches the bottom, not the walls that the leaf's ball also holds.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "built_shape.h"
#include "deepest_contact.h"
#include "test_solids.h"

namespace cairn::test::slot_test {
namespace {

constexpr double kHalfWidth = 0.05, kDepth = 0.5, kHalfLength = 1;  // of the slot, in a block of 1 by 2 by 1 m

constexpr double kAbove = 0.0005;  // metres over the bottom, within what is told ahead

/// The block about the origin, its slot open upwards and at both ends.
Solid slottedBlock() {
  const std::array<std::array<double, 2>, 8> profile{{{-0.5, -0.5},
                                                      {0.5, -0.5},
                                                      {0.5, 0.5},
                                                      {kHalfWidth, 0.5},
                                                      {kHalfWidth, 0.5 - kDepth},
                                                      {-kHalfWidth, 0.5 - kDepth},
                                                      {-kHalfWidth, 0.5},
                                                      {-0.5, 0.5}}};
  const auto at = [&](std::size_t i, double y) { return Vec3d{profile[i % 8][0], y, profile[i % 8][1]}; };
  detail::SolidWriter out;
  const auto quad = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    out.triangle(a, b, c);
    out.triangle(a, c, d);
  };
  for (std::size_t i = 0; i < 8; ++i)
    quad(at(i, -kHalfLength), at(i, kHalfLength), at(i + 1, kHalfLength), at(i + 1, -kHalfLength));
  for (const auto& [a, b, c, d] : {std::array<std::size_t, 4>{0, 1, 4, 5}, {1, 2, 3, 4}, {0, 5, 6, 7}}) {
    quad(at(a, -kHalfLength), at(b, -kHalfLength), at(c, -kHalfLength), at(d, -kHalfLength));
    quad(at(d, kHalfLength), at(c, kHalfLength), at(b, kHalfLength), at(a, kHalfLength));
  }
  return out.solid;
}

// A leaf's point may be where its ball, less the certified error, ends: within twice that error of one of the body's.
TEST(Slot, BladeIsToldNoDeeperThanLeavesMayErr) {
  const btVector3 half(btScalar(0.03), btScalar(0.2), btScalar(0.4));
  for (const std::uint32_t depth : {2U, 3U})
    for (const double along : {-0.5, -0.2, 0.0, 0.3}) {
      BulletWorld<> w;
      const auto block = builtShape(slottedBlock(), depth);
      const SphereTree& tree = static_cast<const bullet::SphereTreeShape&>(*block).tree();
      w.add(block, 0, btVector3(0, 0, 0));
      btRigidBody& blade = w.add(std::make_shared<btBoxShape>(half), 1,
                                 btVector3(0, btScalar(along), btScalar(0.5 - kDepth) + half.z() + btScalar(kAbove)));
      DeepestContact deepest;
      w.world.contactTest(&blade, deepest);
      EXPECT_LT(deepest.separation, 1) << depth << " levels, " << along << " m along: nothing told";
      EXPECT_GE(deepest.separation, -2 * tree.levelError(depth)) << depth << " levels, " << along << " m along";
    }
}

}  // namespace
}  // namespace cairn::test::slot_test
