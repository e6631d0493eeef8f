// SPDX-License-Identifier: GPL-3.0-or-later
#include "rolling.h"

#include <cmath>
#include <numbers>

namespace cairn::hard {

double rollDown(const test::TriedBody& tried, const RollingStart& start) {
  const double angle = start.degrees * std::numbers::pi / 180, clock = std::sqrt(start.radius / 0.5);
  const btVector3 up(btScalar(std::sin(angle)), 0, btScalar(std::cos(angle)));
  const btVector3 down(btScalar(std::cos(angle)), 0, btScalar(-std::sin(angle)));
  test::StillWorld w;
  w.add(std::make_shared<btStaticPlaneShape>(up, btScalar(0)), 0, start.at).setFriction(1);
  const btVector3 place = start.at + up * (btScalar(start.radius) + tried.margin);
  const btRigidBody& ball = w.addTried(tried, btTransform(btQuaternion::getIdentity(), place), 1);
  const auto run = [&](double seconds) {
    for (int i = 0; i < int(std::lround(seconds * clock / start.timeStep)); ++i)
      w.world.stepSimulation(btScalar(start.timeStep), 0);
    return double(ball.getLinearVelocity().dot(down));
  };
  const double before = run(0.25), after = run(1);
  return (after - before) / clock / (5.0 / 7 * kGravity * std::sin(angle));
}

}  // namespace cairn::hard
