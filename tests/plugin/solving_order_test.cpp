// SPDX-License-Identifier: Zlib
#include "contacts/solving_order.h"

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace cairn::test::solving_order_test {
namespace {

// A manifold of points with these distances; each remembers its distance in what goes with it through the steps.
btPersistentManifold manifoldOf(const std::vector<btScalar>& distances) {
  btPersistentManifold manifold;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    btManifoldPoint point(btVector3(btScalar(i), 0, 0), btVector3(btScalar(i), 0, 0), btVector3(0, 0, 1), distances[i]);
    point.m_appliedImpulse = distances[i];
    point.m_index0 = static_cast<int>(i);
    manifold.addManifoldPoint(point);
  }
  return manifold;
}

TEST(SolvingOrder, TheDeepestIsAskedLast) {
  for (std::vector<btScalar> left : {std::vector<btScalar>{}, {-1}, {-2, 1}, {-3, 0, 2}, {-3, -2, 0, 1}}) {
    do {
      btPersistentManifold manifold = manifoldOf(left);
      bullet::putDeepestLast(manifold);
      ASSERT_EQ(manifold.getNumContacts(), static_cast<int>(left.size()));
      for (int i = 0; i < manifold.getNumContacts(); ++i) {
        const btManifoldPoint& point = manifold.getContactPoint(i);
        if (i > 0) EXPECT_LT(point.m_distance1, manifold.getContactPoint(i - 1).m_distance1);
        EXPECT_EQ(point.m_appliedImpulse, point.m_distance1) << "what a point remembers goes with it";
      }
    } while (std::ranges::next_permutation(left).found);
  }
}

TEST(SolvingOrder, PointsOfEqualDepthKeepTheirs) {
  btPersistentManifold manifold = manifoldOf({-1, -1, 0, -1});
  bullet::putDeepestLast(manifold);
  const int expected[] = {2, 0, 1, 3};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(manifold.getContactPoint(i).m_index0, expected[i]);
}

}  // namespace
}  // namespace cairn::test::solving_order_test
