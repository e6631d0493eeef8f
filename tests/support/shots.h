// SPDX-License-Identifier: Zlib
#pragma once

#include <cmath>
#include <memory>
#include <random>

#include "bullet_world.h"
#include "test_solids.h"

namespace cairn::test {

// A thin square wall around the origin, its faces along z, and what is shot at it.
inline constexpr btScalar kHalfWidth = 4;          // of the wall, metres
inline constexpr btScalar kHalfThickness = 0.01F;  // of what has any
inline constexpr std::uint32_t kSeed = 20021;

struct Shot {
  btVector3 from, velocity, spin;
  btQuaternion rotation;
};

// At a random place of the wall, from above, at 10 to 300 m/s.
inline Shot randomShot(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1), part(0, 1);
  const auto in = [&](double width) {
    return btVector3(btScalar(width * unit(random)), btScalar(width * unit(random)), 0);
  };
  const double speed = 10 * std::pow(30, part(random));
  btVector3 direction = in(0.7);
  direction.setZ(-1);
  direction.normalize();
  Shot shot;
  shot.velocity = direction * btScalar(speed);
  const btScalar away = btScalar(1.5 + 6 * part(random));
  shot.from = in(0.6 * double(kHalfWidth)) - direction * (away / -direction.z());
  shot.spin =
      btVector3(btScalar(unit(random)), btScalar(unit(random)), btScalar(unit(random))) * btScalar(20 * part(random));
  const btVector3 axis = in(1) + btVector3(0, 0, btScalar(0.5 + part(random)));
  shot.rotation = btQuaternion(axis.normalized(), btScalar(6.28 * part(random)));
  return shot;
}

inline std::shared_ptr<const SphereTree> bullet(int kind) {
  static const std::shared_ptr<const SphereTree> trees[] = {
      plainTree(torus(0.35, 0.12, 16)), plainTree(cuboid({1, 0.3, 0.3}, 3)), plainTree(ball(0.4, 2))};
  return trees[kind % 3];
}

template <class World>
btRigidBody& shoot(World& w, const Shot& shot, const std::shared_ptr<const SphereTree>& tree, bool isContinuous) {
  btRigidBody& body = w.add(treeShape(tree), 1, shot.from, shot.rotation);
  body.setLinearVelocity(shot.velocity);
  body.setAngularVelocity(shot.spin);
  body.setDamping(0, 0);
  if (isContinuous) body.setCcdMotionThreshold(btScalar(0.05));
  return body;
}

// Whether the body ends on the other side of the wall, its middle having gone through and not come back.
template <class World>
bool passesThrough(World& w, const btRigidBody& body, bool isEndless, btScalar timeStep = btScalar(1.0 / 60)) {
  bool isThrough = false;
  for (int i = 0; i < 60; ++i) {
    const btVector3 before = body.getWorldTransform().getOrigin();
    w.world.stepSimulation(timeStep, 0);
    if (!isSane(body)) return true;
    const btVector3 now = body.getWorldTransform().getOrigin();
    if ((before.z() > 0) == (now.z() > 0)) continue;
    const btVector3 at = before.lerp(now, before.z() / (before.z() - now.z()));
    const bool isInside = std::abs(at.x()) < kHalfWidth && std::abs(at.y()) < kHalfWidth;
    isThrough = now.z() < 0 && (isEndless || isInside);
  }
  return isThrough;
}

}  // namespace cairn::test
