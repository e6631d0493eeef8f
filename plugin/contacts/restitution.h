// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/ConstraintSolver/btContactSolverInfo.h>

#include <algorithm>

namespace cairn::bullet {

/// Speed (world length per second) below which nothing bounces: Bullet's default.
inline btScalar slowestBounce() {
  static const btScalar kSlowest = btContactSolverInfo().m_restitutionVelocityThreshold;
  return kSlowest;
}

/// The distance to give Bullet's solver for a contact of bodies that bounce. With it they leave each other at
/// `restitution` times their closing speed, whatever the step.
///
/// The solver's own target is wrong by a speed that grows as steps shrink. Where a point is still apart, it asks for
/// *less* by distance / step. Where a point is slightly too deep, it asks for *more* by a part of depth / step. So:
///
/// | contact | distance given |
/// | --- | --- |
/// | reached within the step | 0: it bounces, up to one step early |
/// | not reached within the step | far enough to have no effect |
/// | slower than Bullet's threshold, or no restitution | unchanged |
///
/// `closingSpeed`: at the contact, world length per second, positive where the surfaces approach. `timeStep`: seconds.
inline btScalar solverDistance(btScalar distance, btScalar closingSpeed, btScalar restitution, btScalar timeStep) {
  if (restitution <= 0 || closingSpeed <= slowestBounce()) return distance;
  const btScalar travel = closingSpeed * timeStep;
  return distance <= travel ? btScalar(0) : std::max(distance, (1 + restitution) * travel);
}

}  // namespace cairn::bullet
