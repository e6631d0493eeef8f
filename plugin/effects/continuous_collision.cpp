// SPDX-License-Identifier: Zlib
#include "cairn/effects/continuous_collision.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::effects {

btScalar ContinuousCollision::innerRadius(const btCollisionShape& shape) {
  if (const bullet::SphereTreeShape* tree = bullet::asSphereTree(&shape)) {
    float greatest = 0;
    for (NodeId node = 0; node < tree->tree().nodeCount(); ++node)
      greatest = std::max(greatest, tree->tree().innerRadius(node));
    if (greatest > 0) return static_cast<btScalar>(greatest) * tree->scale() + tree->getMargin();
  }
  btVector3 lower, upper;
  shape.getAabb(btTransform::getIdentity(), lower, upper);
  const btVector3 width = upper - lower;
  return std::min({width.x(), width.y(), width.z()}) / 2;
}

void ContinuousCollision::welcome(Body& known) {
  if (before_.size() <= known.id) {
    before_.resize(known.id + 1);
    leastSquare_.resize(known.id + 1);
  }
  btRigidBody& body = *known.body;
  before_[known.id] = {body.getCcdMotionThreshold(), body.getCcdSweptSphereRadius()};
  if (!(options_.radiiPerStep > 0)) return;
  const btScalar radius = innerRadius(*body.getCollisionShape()), threshold = options_.radiiPerStep * radius;
  leastSquare_[known.id] = threshold * threshold;
  body.setCcdMotionThreshold(threshold);
  body.setCcdSweptSphereRadius(radius / 2);
}

void ContinuousCollision::dismiss(Body& known) {
  known.body->setCcdMotionThreshold(before_[known.id].threshold);
  known.body->setCcdSweptSphereRadius(before_[known.id].sweptRadius);
}

std::uint32_t ContinuousCollision::applyForces(std::span<Body* const> bodies, const Step& step) {
  if (!(options_.radiiPerStep > 0)) return 0;
  const btScalar perSquareMetre = step.timeStep * step.timeStep;
  return static_cast<std::uint32_t>(std::ranges::count_if(bodies, [&](const Body* known) {
    return known->body->getLinearVelocity().length2() * perSquareMetre > leastSquare_[known->id];
  }));
}

}  // namespace cairn::effects
