// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <array>
#include <cstddef>

#include "cairn/effects/effect_set.h"

struct btSolverBody;

namespace cairn::effects {

/// The resistance to rolling and spinning at a contact in a step, and its impulses once the step is solved.
struct Resistance {
  const btManifoldPoint* point;
  btScalar rolling, spinning;  ///< m, torque per normal force
  const Contact* contact;      ///< of the point
  Work work;
};

/// The torque impulse between two bodies at a contact that resists their rolling and spinning on each other: in the
/// contact's plane at most `rolling` times the normal impulse in any direction, about its normal at most `spinning`
/// times it. Either stops the relative spin if it can, else it is opposed to it and at its limit. Solved by projected
/// steps from what has been applied, as the solver's own rows are.
class RollingRow {
 public:
  /// Bodies that are null do not turn.
  RollingRow(const Resistance& resistance, const btRigidBody* a, const btRigidBody* b);

  /// One iteration. The change of angular momentum it made, N m s.
  btScalar solve(btSolverBody& a, btSolverBody& b, btScalar normalImpulse);
  /// After the last.
  Work work(const btSolverBody& a, const btSolverBody& b) const;

 private:
  static constexpr std::size_t kAcross = 0, kAlong = 1, kNormal = 2;

  btScalar rolling_, spinning_;
  std::array<btVector3, 3> axes_;  // two in the contact's plane and its normal
  // By axis, how a torque impulse of one about it turns either body.
  std::array<btVector3, 3> turnsA_, turnsB_;
  btScalar rollingMoment_, spinningMoment_;  // the least in the plane and that about the normal, of both, kg m^2
  std::array<btScalar, 3> applied_{};        // to body A, N m s
};

}  // namespace cairn::effects
