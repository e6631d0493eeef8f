// SPDX-License-Identifier: Zlib
#include "cairn/bullet/tree_drawing.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <algorithm>
#include <cmath>

#include "placement/bullet_math.h"

namespace cairn::bullet {

double onErrorScale(double errorFraction) {
  return std::log(errorFraction / kMinErrorShown) / std::log(kMaxErrorShown / kMinErrorShown);
}

btVector3 errorColor(double errorFraction) {
  const double fraction = std::clamp(errorFraction, kMinErrorShown, kMaxErrorShown);
  const double at = std::clamp(onErrorScale(fraction), 0.0, 1.0) * (kErrorColors.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), kErrorColors.size() - 2);
  const double weight = at - static_cast<double>(i);
  btVector3 color(0, 0, 0);
  for (std::size_t c = 0; c < 3; ++c)
    color[static_cast<int>(c)] = btScalar((1 - weight) * kErrorColors[i][c] + weight * kErrorColors[i + 1][c]);
  return color;
}

void drawTree(btIDebugDraw& drawer, const btTransform& bodyTransform, const SphereTreeShape& shape,
              std::uint32_t level) {
  const btTransform worldFromTree = bodyTransform * shape.bodyFromTree();
  for (const NodeId node : shape.tree().levelCut(level)) {
    const Sphere sphere = shape.tree().sphere(node);
    const btTransform place(worldFromTree.getBasis(), worldFromTree * (toBullet(sphere.center) * shape.scale()));
    drawer.drawSphere(btScalar(sphere.radius) * shape.scale() + shape.getMargin(), place,
                      errorColor(double(shape.tree().error(node)) * double(shape.scale()) / double(shape.size())));
  }
}

namespace {

void drawTreesOf(btIDebugDraw& drawer, const btTransform& transform, const btCollisionShape& shape,
                 std::uint32_t level) {
  if (const SphereTreeShape* tree = asSphereTree(&shape)) return drawTree(drawer, transform, *tree, level);
  if (!shape.isCompound()) return;
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i)
    drawTreesOf(drawer, transform * compound.getChildTransform(i), *compound.getChildShape(i), level);
}

}  // namespace

void drawTrees(btCollisionWorld& world, std::uint32_t level) {
  btIDebugDraw* drawer = world.getDebugDrawer();
  if (drawer == nullptr) return;
  for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
    const btCollisionObject& object = *world.getCollisionObjectArray()[i];
    if ((object.getCollisionFlags() & btCollisionObject::CF_DISABLE_VISUALIZE_OBJECT) != 0) continue;
    drawTreesOf(*drawer, object.getWorldTransform(), *object.getCollisionShape(), level);
  }
}

}  // namespace cairn::bullet
