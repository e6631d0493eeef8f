// SPDX-License-Identifier: Zlib
// Lumped tangential restitution: what 2D tools mean by Rt.
#include "cairn/effects/tangential_restitution.h"

#include <gtest/gtest.h>

#include "cairn/effects/friction.h"
#include "cairn/effects/restitution.h"
#include "slope_world.h"

namespace cairn::test::tangential_restitution_test {
namespace {

using effects::PairTable;

constexpr btScalar kRadius = btScalar(0.5), kDown = 6, kAlong = 4;

struct Blow {
  btVector3 velocity, spin;
};

Blow blowWith(btScalar part) {
  SlopeWorld world(0, 1000);
  world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.6)));
  world.add<effects::Restitution>(PairTable<btScalar>(btScalar(0.5)), effects::restitution::Constant{});
  world.add<effects::TangentialRestitution>(PairTable<btScalar>(part));
  btRigidBody& ball =
      world.addBody(std::make_shared<btSphereShape>(kRadius), 5, btVector3(0, 0, kRadius + btScalar(0.05)));
  ball.setLinearVelocity(btVector3(kAlong, 0, -kDown));
  ball.setAngularVelocity(btVector3(1, 2, 3));
  world.run(btScalar(0.03));
  EXPECT_EQ(world.set().report()[2].acted, 1U) << "one blow";
  return {ball.getLinearVelocity(), ball.getAngularVelocity()};
}

TEST(TangentialRestitution, LeavesThePartAskedForAndTheSpin) {
  for (const btScalar part : {btScalar(0), btScalar(0.35), btScalar(0.8), btScalar(1)}) {
    const Blow blow = blowWith(part);
    EXPECT_NEAR(blow.velocity.x(), part * kAlong, 1e-3 * kAlong) << part;
    EXPECT_NEAR(blow.velocity.y(), 0, 1e-3);
    EXPECT_NEAR((blow.spin - btVector3(1, 2, 3)).length(), 0, 1e-3);
  }
}

TEST(TangentialRestitution, LeavesFrictionAtRestAlone) {
  SlopeWorld world(radians(20));
  world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.6)));
  world.add<effects::TangentialRestitution>(PairTable<btScalar>(btScalar(0.9)));
  const btVector3 up(btSin(radians(20)), 0, btCos(radians(20)));
  btRigidBody& box = world.addBody(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(.5))), 10, up * btScalar(.5));
  box.setWorldTransform(btTransform(btQuaternion(btVector3(0, 1, 0), radians(20)), up * btScalar(.5)));
  world.run(3);
  EXPECT_LT((box.getWorldTransform().getOrigin() - up * btScalar(.5)).length(), 0.02) << "0.6 holds at 20 degrees";
}

}  // namespace
}  // namespace cairn::test::tangential_restitution_test
