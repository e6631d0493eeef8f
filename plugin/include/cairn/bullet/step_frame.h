// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <algorithm>

namespace cairn::bullet {

/// How many steps `world.stepSimulation` with the same arguments would make now: Bullet's own rule, clamped by
/// `maxSubSteps` (0: one step of the whole time, whatever it is). Times in seconds. Precondition: `maxSubSteps >= 0`,
/// `fixedTimeStep > 0`.
inline int stepsOf(const btDiscreteDynamicsWorld& world, btScalar timeStep, int maxSubSteps = 1,
                   btScalar fixedTimeStep = btScalar(1) / btScalar(60)) {
  // What earlier frames left is known to derived classes only.
  struct Reader : btDiscreteDynamicsWorld {
    static btScalar localTime(const btDiscreteDynamicsWorld& w) { return w.*(&Reader::m_localTime); }
  };
  if (maxSubSteps == 0) return btFuzzyZero(timeStep) ? 0 : 1;
  const btScalar time = Reader::localTime(world) + timeStep;
  return time >= fixedTimeStep ? std::min(static_cast<int>(time / fixedTimeStep), maxSubSteps) : 0;
}

/// `world.stepSimulation` with one budget for all its steps together: set it once with `frontEnd.setFrameBudget`, and
/// call this where `stepSimulation` was. `frontEnd` is the `Dispatcher` or installed `NarrowPhase` of that world.
template <class FrontEnd>
int stepFrame(btDiscreteDynamicsWorld& world, FrontEnd& frontEnd, btScalar timeStep, int maxSubSteps = 1,
              btScalar fixedTimeStep = btScalar(1) / btScalar(60)) {
  frontEnd.beginFrame(stepsOf(world, timeStep, maxSubSteps, fixedTimeStep));
  return world.stepSimulation(timeStep, maxSubSteps, fixedTimeStep);
}

}  // namespace cairn::bullet
