// SPDX-License-Identifier: Zlib
#include "dispatch/body_motion.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "shape/bullet_math.h"

namespace cairn::bullet {

namespace {

float inverseMass(const btCollisionObject& object) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  return body ? static_cast<float>(body->getInvMass()) : 0;
}

}  // namespace

Vec3 linearVelocity(const btCollisionObject& object) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  return toVec3(body ? body->getLinearVelocity() : object.getInterpolationLinearVelocity());
}

Vec3 angularVelocity(const btCollisionObject& object) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  return toVec3(body ? body->getAngularVelocity() : object.getInterpolationAngularVelocity());
}

float closingSpeed(const btCollisionObject& first, const btCollisionObject& second, float disc) {
  return length(linearVelocity(first) - linearVelocity(second)) +
         length(angularVelocity(first) - angularVelocity(second)) * disc;
}

float speedInFrameOf(const btCollisionObject& second, const btCollisionObject& first, float disc) {
  const Vec3 apart = toVec3(first.getWorldTransform().getOrigin() - second.getWorldTransform().getOrigin());
  const Vec3 carried = cross(angularVelocity(second), apart);
  return length(linearVelocity(first) - linearVelocity(second) - carried) +
         length(angularVelocity(first) - angularVelocity(second)) * disc;
}

float reducedMass(const btCollisionObject& first, const btCollisionObject& second) {
  const float inverseMasses = inverseMass(first) + inverseMass(second);
  return inverseMasses > 0 ? 1 / inverseMasses : 0;
}

}  // namespace cairn::bullet
