// SPDX-License-Identifier: Zlib
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::simulation {

/// Where something is: of a body, where its mesh's own frame is.
struct Pose {
  btVector3 position{0, 0, 0};
  btQuaternion rotation{0, 0, 0, 1};
};

/// What a surface does to another: Bullet multiplies the values of both.
struct Material {
  btScalar friction = btScalar(0.5);
  btScalar restitution = 0;
};

/// A body of a tree, with what it keeps alive.
struct Body {
  std::shared_ptr<bullet::SphereTreeShape> shape;
  std::unique_ptr<btRigidBody> rigid;
  std::unique_ptr<btPoint2PointConstraint> drag;  ///< while somebody holds it

  btTransform pose() const { return rigid->getWorldTransform() * shape->bodyFromMesh(); }
};

/// A plane or a box that never moves.
struct Obstacle {
  std::unique_ptr<btCollisionShape> shape;
  std::unique_ptr<btRigidBody> rigid;
};

}  // namespace cairn::simulation
