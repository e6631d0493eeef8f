// SPDX-License-Identifier: Zlib
#include "rolling_row.h"

#include <BulletDynamics/ConstraintSolver/btSolverBody.h>

#include <algorithm>
#include <cmath>

namespace cairn::effects {
namespace {

btVector3 turned(const btRigidBody* body, const btVector3& axis) {
  return body != nullptr ? body->getInvInertiaTensorWorld() * axis * body->getAngularFactor() : btVector3(0, 0, 0);
}

btVector3 spinOf(const btSolverBody& body) {
  return body.m_angularVelocity + body.m_externalTorqueImpulse + body.getDeltaAngularVelocity();
}

// Zero for what nothing turns.
btScalar inverse(btScalar value) {
  return value > 0 ? 1 / value : btScalar(0);
}

}  // namespace

RollingRow::RollingRow(const Resistance& resistance, const btRigidBody* a, const btRigidBody* b)
    : rolling_(resistance.rolling), spinning_(resistance.spinning) {
  axes_[kNormal] = resistance.point->m_normalWorldOnB;
  btPlaneSpace1(axes_[kNormal], axes_[kAcross], axes_[kAlong]);
  std::array<btVector3, 3> turns;  // of both together
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    turnsA_[i] = turned(a, axes_[i]);
    turnsB_[i] = turned(b, axes_[i]);
    turns[i] = turnsA_[i] + turnsB_[i];
  }
  // A step by the greatest inverse moment in the plane overshoots in no direction.
  const btScalar mean = (axes_[kAcross].dot(turns[kAcross]) + axes_[kAlong].dot(turns[kAlong])) / 2;
  const btScalar half = (axes_[kAcross].dot(turns[kAcross]) - axes_[kAlong].dot(turns[kAlong])) / 2;
  rollingMoment_ = inverse(mean + std::hypot(half, axes_[kAcross].dot(turns[kAlong])));
  spinningMoment_ = inverse(axes_[kNormal].dot(turns[kNormal]));
}

btScalar RollingRow::solve(btSolverBody& a, btSolverBody& b, btScalar normalImpulse) {
  const btVector3 spin = spinOf(a) - spinOf(b);
  const btScalar load = std::max(normalImpulse, btScalar(0));
  std::array<btScalar, 3> wanted;
  wanted[kAcross] = applied_[kAcross] - rollingMoment_ * axes_[kAcross].dot(spin);
  wanted[kAlong] = applied_[kAlong] - rollingMoment_ * axes_[kAlong].dot(spin);
  const btScalar length = std::hypot(wanted[kAcross], wanted[kAlong]), limit = rolling_ * load;
  if (length > limit) {
    wanted[kAcross] *= limit / length;
    wanted[kAlong] *= limit / length;
  }
  wanted[kNormal] =
      std::clamp(applied_[kNormal] - spinningMoment_ * axes_[kNormal].dot(spin), -spinning_ * load, spinning_ * load);
  btScalar change = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const btScalar more = wanted[i] - applied_[i];
    a.internalGetDeltaAngularVelocity() += turnsA_[i] * more;
    b.internalGetDeltaAngularVelocity() -= turnsB_[i] * more;
    applied_[i] = wanted[i];
    change += std::abs(more);
  }
  return change;
}

Work RollingRow::work(const btSolverBody& a, const btSolverBody& b) const {
  const btVector3 impulse =
      axes_[kAcross] * applied_[kAcross] + axes_[kAlong] * applied_[kAlong] + axes_[kNormal] * applied_[kNormal];
  const btVector3 after = spinOf(a) - spinOf(b);
  const btVector3 middle = after - (a.getDeltaAngularVelocity() - b.getDeltaAngularVelocity()) / 2;
  return {-double(impulse.dot(middle)), 0, double(impulse.length())};
}

}  // namespace cairn::effects
