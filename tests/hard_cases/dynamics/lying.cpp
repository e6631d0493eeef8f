// SPDX-License-Identifier: GPL-3.0-or-later
#include "lying.h"

#include <cmath>
#include <limits>

namespace cairn::hard {
namespace {

Vec3d placeOf(const btRigidBody& body) {
  const btVector3& p = body.getWorldTransform().getOrigin();
  return {double(p.x()), double(p.y()), double(p.z())};
}

}  // namespace

Figures lie(const test::TriedBody& tried, const LyingStart& start) {
  test::StillWorld w;
  w.addGround();
  w.resist(start.resisted);
  btVector3 lower, upper;
  tried.shape->getAabb(btTransform::getIdentity(), lower, upper);
  const btTransform at(btQuaternion::getIdentity(), btVector3(0, 0, -lower.z()));
  const btRigidBody& body = w.addTried(tried, at, btScalar(0.5));
  const auto step = [&] { w.world.stepSimulation(btScalar(start.timeStep), 0); };
  for (int i = 0; i < int(start.settling / start.timeStep); ++i) step();
  const Vec3d first = placeOf(body);
  const int steps = int(std::lround(start.seconds / start.timeStep));
  Vec3d sum, squares;  // of the way from the first place
  for (int i = 0; i < steps; ++i) {
    step();
    const Vec3d way = placeOf(body) - first;
    sum += way;
    squares += Vec3d(way.x * way.x, way.y * way.y, way.z * way.z);
  }
  if (!test::isSane(body)) return Figures(2, std::numeric_limits<double>::quiet_NaN());
  const Vec3d mean = sum / steps;
  const double variance = (squares.x + squares.y + squares.z) / steps - dot(mean, mean);
  return {100 * std::sqrt(std::max(variance, 0.0)) / start.size, 100 * length(placeOf(body) - first) / start.size};
}

}  // namespace cairn::hard
