// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include "cairn/core/export.h"

namespace cairn::bullet {

/// How many steps `world.stepSimulation` would make now with the same arguments. Follows Bullet's rule and clamps by
/// `maxSubSteps`; 0 means one step of the whole time, as in Bullet. Times in seconds. Precondition: `maxSubSteps >= 0`,
/// `fixedTimeStep > 0`.
inline int stepsOf(const btDiscreteDynamicsWorld& world, btScalar timeStep, int maxSubSteps = 1,
                   btScalar fixedTimeStep = btScalar(1) / btScalar(60)) {
  // Only derived classes can read the time left from earlier frames.
  struct Reader : btDiscreteDynamicsWorld {
    static btScalar localTime(const btDiscreteDynamicsWorld& w) { return w.*(&Reader::m_localTime); }
  };
  if (maxSubSteps == 0) return btFuzzyZero(timeStep) ? 0 : 1;
  const btScalar time = Reader::localTime(world) + timeStep;
  return time >= fixedTimeStep ? btMin(static_cast<int>(time / fixedTimeStep), maxSubSteps) : 0;
}

/// `world.stepSimulation` with one budget for all its steps together:
///
///     if (!dispatcher.setFrameBudget({.microseconds = 2000})) return 1;  // once
///     stepFrame(world, dispatcher, timeStep, maxSubSteps);  // instead of world.stepSimulation
///
/// `frontEnd` is the `Dispatcher` or the installed `NarrowPhase` of that world. Returns the number of steps made.
template <class FrontEnd>
int stepFrame(btDiscreteDynamicsWorld& world, FrontEnd& frontEnd, btScalar timeStep, int maxSubSteps = 1,
              btScalar fixedTimeStep = btScalar(1) / btScalar(60)) {
  frontEnd.beginFrame(stepsOf(world, timeStep, maxSubSteps, fixedTimeStep));
  return world.stepSimulation(timeStep, maxSubSteps, fixedTimeStep);
}

}  // namespace cairn::bullet
