// SPDX-License-Identifier: Zlib
#include "continuous/trajectory.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <LinearMath/btTransformUtil.h>

#include <algorithm>

namespace cairn::bullet {

namespace {

// Bullet clamps a body's rotation to 45 degrees a step.
btVector3 clampedTurn(const btVector3& angular, btScalar timeStep) {
  const btScalar turn = angular.length() * timeStep;
  return turn > ANGULAR_MOTION_THRESHOLD ? angular * (ANGULAR_MOTION_THRESHOLD / turn) : angular;
}

}  // namespace

Trajectory::Trajectory(const btCollisionObjectWrapper& body, btScalar timeStep)
    : object_(body.getCollisionObject()->getWorldTransform()),
      childInObject_(object_.inverseTimes(body.getWorldTransform())),
      linear_(body.getCollisionObject()->getInterpolationLinearVelocity()),
      angular_(body.getCollisionObject()->getInterpolationAngularVelocity()),
      timeStep_(timeStep),
      isRound_(body.getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE) {
  if (const btRigidBody* const rigid = btRigidBody::upcast(body.getCollisionObject())) {
    linear_ = rigid->getLinearVelocity() +
              rigid->getTotalForce() * rigid->getLinearFactor() * (rigid->getInvMass() * timeStep);
    angular_ = rigid->getAngularVelocity();
  }
  angular_ = clampedTurn(angular_, timeStep);
}

Trajectory Trajectory::along(const btVector3& normal, const Trajectory& other) const {
  Trajectory along = *this;
  along.linear_ -= normal * std::min(normal.dot(linear_ - other.linear_), btScalar(0));
  return along;
}

// A sphere that is an off-centre child of a compound moves on an arc.
btScalar Trajectory::turn() const {
  if (isRound_ && childInObject_.getOrigin().fuzzyZero()) return 0;
  return angular_.length() * timeStep_;
}

btTransform Trajectory::at(btScalar fraction) const {
  btTransform moved;
  btTransformUtil::integrateTransform(object_, linear_, angular_, timeStep_ * fraction, moved);
  btTransform child = moved * childInObject_;
  if (isRound_) child.setBasis(btMatrix3x3::getIdentity());
  return child;
}

}  // namespace cairn::bullet
