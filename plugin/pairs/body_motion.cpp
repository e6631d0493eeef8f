// SPDX-License-Identifier: Zlib
#include "pairs/body_motion.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cmath>
#include <limits>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/tree_surface.h"
#include "kernel/contact_tuning.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

float inverseMass(const btCollisionObject& object) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  return body ? static_cast<float>(body->getInvMass()) : 0;
}

// The solver reads only the place of any other body.
bool isMoved(const btRigidBody& body) {
  return body.getInvMass() != 0 || body.isKinematicObject();
}

// A sum with a NaN or infinite term is not finite.
btScalar sumOf(const btVector3& v) {
  return v.x() + v.y() + v.z();
}

btScalar sumOf(const btTransform& pose) {
  return sumOf(pose.getOrigin() + pose.getBasis()[0] + pose.getBasis()[1] + pose.getBasis()[2]);
}

// Thickness of a shell's wall, world length; infinite for a solid.
float wallOf(const SphereTreeShape& shape) {
  const float thickness = shape.tree().surface().thickness * static_cast<float>(shape.scale());
  const bool isShell = thickness < tuning::kTrustedDepth * static_cast<float>(shape.size());
  return isShell ? thickness : std::numeric_limits<float>::infinity();
}

}  // namespace

Vec3 linearVelocity(const btCollisionObject& object) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  if (body && !isMoved(*body)) return {};
  return toVec3(body ? body->getLinearVelocity() : object.getInterpolationLinearVelocity());
}

Vec3 angularVelocity(const btCollisionObject& object) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  if (body && !isMoved(*body)) return {};
  return toVec3(body ? body->getAngularVelocity() : object.getInterpolationAngularVelocity());
}

float closingSpeed(const btCollisionObject& first, const btCollisionObject& second, float disc) {
  return length(linearVelocity(first) - linearVelocity(second)) +
         length(angularVelocity(first) - angularVelocity(second)) * disc;
}

float fastTravel(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, btScalar time) {
  const btCollisionObject &first = *body0.getCollisionObject(), &second = *body1.getCollisionObject();
  const btScalar one = first.getCcdMotionThreshold(), two = second.getCcdMotionThreshold();
  if (time <= 0 || (one <= 0 && two <= 0) || !first.hasContactResponse() || !second.hasContactResponse()) return 0;
  const SphereTreeShape* const tree0 = asSphereTree(body0.getCollisionShape());
  const SphereTreeShape* const shape = tree0 ? tree0 : asSphereTree(body1.getCollisionShape());
  const float disc = shape ? static_cast<float>(shape->getAngularMotionDisc()) : 0;
  const float travel = closingSpeed(first, second, disc) * static_cast<float>(time);
  const bool isFast = (one > 0 && travel > static_cast<float>(one)) || (two > 0 && travel > static_cast<float>(two));
  return isFast && std::isfinite(travel) ? travel : 0;
}

float wallTravel(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, btScalar time) {
  const SphereTreeShape *const tree0 = asSphereTree(body0.getCollisionShape()), *const tree1 = asSphereTree(
                                                                                    body1.getCollisionShape());
  if (time <= 0 || !tree0 || !tree1) return 0;
  const float thinner = std::min(wallOf(*tree0), wallOf(*tree1));
  if (!std::isfinite(thinner)) return 0;
  const btCollisionObject &first = *body0.getCollisionObject(), &second = *body1.getCollisionObject();
  const float speed = std::min(speedInFrameOf(second, first, static_cast<float>(tree0->getAngularMotionDisc())),
                               speedInFrameOf(first, second, static_cast<float>(tree1->getAngularMotionDisc())));
  const float travel = speed * static_cast<float>(time);
  const bool mayCross = travel > tuning::kTrustedThickness * thinner;
  return mayCross ? std::min(travel, tuning::kMaxWalls * thinner) : 0;
}

float speedInFrameOf(const btCollisionObject& second, const btCollisionObject& first, float disc) {
  const Vec3 apart = toVec3(first.getWorldTransform().getOrigin() - second.getWorldTransform().getOrigin());
  const Vec3 carried = cross(angularVelocity(second), apart);
  return length(linearVelocity(first) - linearVelocity(second) - carried) +
         length(angularVelocity(first) - angularVelocity(second)) * disc;
}

float speedIn(const btCollisionObjectWrapper& larger, const btCollisionObjectWrapper& smaller) {
  return speedInFrameOf(*larger.getCollisionObject(), *smaller.getCollisionObject(),
                        static_cast<float>(smaller.getCollisionShape()->getAngularMotionDisc()));
}

bool isNonFinite(const btCollisionObject& object) {
  if (!std::isfinite(sumOf(object.getWorldTransform()))) return true;
  const btRigidBody* const body = btRigidBody::upcast(&object);
  if (!body || !isMoved(*body)) return false;
  return !std::isfinite(
      sumOf(body->getLinearVelocity() + body->getAngularVelocity() + body->getTotalForce() + body->getTotalTorque()));
}

bool isNonFinite(const btCollisionObjectWrapper& wrapper) {
  return !std::isfinite(sumOf(wrapper.getWorldTransform())) || isNonFinite(*wrapper.getCollisionObject());
}

float reducedMass(const btCollisionObject& first, const btCollisionObject& second) {
  const float inverseMasses = inverseMass(first) + inverseMass(second);
  return inverseMasses > 0 ? 1 / inverseMasses : 0;
}

}  // namespace cairn::bullet
