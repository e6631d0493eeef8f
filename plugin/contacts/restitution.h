// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/ConstraintSolver/btContactSolverInfo.h>

#include <algorithm>

namespace cairn::bullet {

/// World length per second below which nothing bounces: Bullet's default.
inline btScalar slowestBounce() {
  static const btScalar kSlowest = btContactSolverInfo().m_restitutionVelocityThreshold;
  return kSlowest;
}

/// The distance Bullet's solver is told for a contact of bodies that bounce, so that they leave each other at
/// `restitution` times the speed they came with, whatever the step.
///
/// The solver asks for that speed *less* distance / step where a point is still ahead, and *more* by a part of depth /
/// step where it is a little too deep: errors that grow as steps shrink, because the distances do not. So a point that
/// is reached within the step is told as touching, and bounces up to one step early; one that is not is told as far off
/// as it takes to have no say. Below the speed at which solvers bounce (Bullet's default; what is slower rests), and
/// where nothing bounces, the distance stays what it is.
///
/// `closingSpeed`: at the contact, world length per second, positive where the surfaces approach. `timeStep`: seconds.
inline btScalar distanceToTell(btScalar distance, btScalar closingSpeed, btScalar restitution, btScalar timeStep) {
  if (restitution <= 0 || closingSpeed <= slowestBounce()) return distance;
  const btScalar travel = closingSpeed * timeStep;
  return distance <= travel ? btScalar(0) : std::max(distance, (1 + restitution) * travel);
}

}  // namespace cairn::bullet
