// SPDX-License-Identifier: Zlib
#include "contacts/manifold_writer.h"

#include <btBulletCollisionCommon.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace cairn::test::manifold_writer_test {
namespace {

using namespace cairn::bullet;

constexpr float kInheritance = 0.02F;
constexpr std::array<Vec3, kMaxPoints> kCorners{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};

RelativeMotion resting() {
  RelativeMotion motion;
  motion.timeStep = 1.0F / 60;
  motion.maxSeparation = motion.reported = 0.002F;
  return motion;
}

// Two bodies, one manifold between them, and what is written into it.
class Written {
 public:
  Written() : manifold(&objects_[0], &objects_[1], 0, btScalar(0.05), btScalar(0.05)) {
    for (btCollisionObject& object : objects_) object.setCollisionShape(&shape_);
  }

  /// At these corners, in this order, with these ids, each as deep as its corner's number says.
  void write(const std::vector<std::size_t>& corners, const std::vector<int>& ids) {
    std::vector<Contact> cluster;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Contact contact;
      contact.position = kCorners[corners[i]];
      contact.normal = {0, 0, 1};
      contact.separation = -0.001F * static_cast<float>(corners[i] + 1);
      contact.id.treeIndex = ids[i];
      cluster.push_back(contact);
    }
    const btCollisionObjectWrapper of0(nullptr, &shape_, &objects_[0], objects_[0].getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper of1(nullptr, &shape_, &objects_[1], objects_[1].getWorldTransform(), -1, -1);
    btManifoldResult result(&of0, &of1);
    ManifoldWriter(result, btVector3(0, 0, 0), true, kInheritance, motion).write(manifold, cluster);
  }

  btManifoldPoint& at(std::size_t corner) {
    int nearest = 0;
    for (int i = 1; i < manifold.getNumContacts(); ++i)
      if (distance(i, corner) < distance(nearest, corner)) nearest = i;
    return manifold.getContactPoint(nearest);
  }

  btScalar distance(int point, std::size_t corner) const {
    const Vec3& c = kCorners[corner];
    const btVector3& p = manifold.getContactPoint(point).getPositionWorldOnB();
    return std::hypot(p.x() - btScalar(c.x), p.y() - btScalar(c.y));
  }

 private:
  btSphereShape shape_{1};
  std::array<btCollisionObject, 2> objects_;

 public:
  RelativeMotion motion = resting();
  btPersistentManifold manifold;
};

// A face's corners are named by whichever leaves reported them first: several by the same ones, and by others in the
// next step.
TEST(ManifoldWriter, WhatLiesStillKeepsItsImpulsesWhateverItsName) {
  Written w;
  w.write({0, 1, 2, 3}, {7, 7, 8, 8});
  for (std::size_t c = 0; c < kCorners.size(); ++c) w.at(c).m_appliedImpulse = btScalar(c + 1);
  w.write({3, 1, 0, 2}, {7, 8, 8, 7});
  ASSERT_EQ(w.manifold.getNumContacts(), kMaxPoints);
  for (std::size_t c = 0; c < kCorners.size(); ++c) {
    EXPECT_EQ(w.at(c).m_appliedImpulse, btScalar(c + 1)) << "corner " << c;
    EXPECT_EQ(w.at(c).m_lifeTime, 1) << "corner " << c;
  }
}

// A leaf's support point goes from one end of it to the other as the leaf turns.
TEST(ManifoldWriter, WhatMovedFarInheritsByName) {
  Written w;
  w.write({0, 1}, {7, 8});
  w.at(0).m_appliedImpulse = 1;
  w.at(1).m_appliedImpulse = 2;
  w.write({2, 3}, {8, 7});
  EXPECT_EQ(w.at(2).m_appliedImpulse, 2);
  EXPECT_EQ(w.at(3).m_appliedImpulse, 1);
}

// Far from its bodies' origins two contacts can round to one place: Bullet replaces one old point twice, and the other
// is none of this step's. Solved where it was, a rock 1e6 m deep in a plane was thrown at 1e13 m/s.
TEST(ManifoldWriter, NoPointStaysThatWasNotToldAgain) {
  Written w;
  w.write({0, 1, 3}, {7, 8, 9});
  w.write({2, 2, 3}, {7, 8, 9});
  ASSERT_EQ(w.manifold.getNumContacts(), 2);
  EXPECT_EQ(w.distance(0, 2) + w.distance(1, 3), 0);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(w.manifold.getContactPoint(i).m_lifeTime, 1);
}

TEST(ManifoldWriter, TheSolverIsAskedTheDeepestLast) {
  Written w;
  w.write({2, 0, 3, 1}, {1, 2, 3, 4});
  for (int i = 0; i < kMaxPoints; ++i) EXPECT_EQ(w.distance(i, static_cast<std::size_t>(i)), 0);
}

// The deepest of what rolls is another one in every step.
TEST(ManifoldWriter, WhatMovesKeepsItsOrder) {
  Written w;
  w.motion.treeLinear = {1, 0, 0};
  w.write({2, 0, 3, 1}, {1, 2, 3, 4});
  EXPECT_EQ(w.distance(0, 2), 0);
  EXPECT_EQ(w.distance(1, 0), 0);
}

}  // namespace
}  // namespace cairn::test::manifold_writer_test
