// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes_from_bytes.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btUniformScalingShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <utility>
#include <vector>

#include "distance_fields.h"
#include "require.h"
#include "terrains.h"
#include "trees_from_bytes.h"
#include "triangle_grounds.h"

namespace cairn::fuzz {
namespace {

using ShapePtr = std::shared_ptr<btCollisionShape>;

btScalar lengthFrom(Bytes& bytes, btScalar size) {
  return size * btScalar(bytes.part());
}
btVector3 pointFrom(Bytes& bytes, btScalar size) {
  return {size * btScalar(bytes.between(-1, 1)), size * btScalar(bytes.between(-1, 1)),
          size * btScalar(bytes.between(-1, 1))};
}
btVector3 halfExtentsFrom(Bytes& bytes, btScalar size) {
  return {lengthFrom(bytes, size), lengthFrom(bytes, size), lengthFrom(bytes, size)};
}

ShapePtr hullFrom(Bytes& bytes, btScalar size) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (std::uint32_t i = 1 + bytes.below(8); i > 0; --i) hull->addPoint(pointFrom(bytes, size), false);
  hull->recalcLocalAabb();
  return hull;
}

ShapePtr ballsFrom(Bytes& bytes, btScalar size) {
  const btVector3 centers[2] = {pointFrom(bytes, size), pointFrom(bytes, size)};
  const btScalar radii[2] = {lengthFrom(bytes, size), lengthFrom(bytes, size)};
  return std::make_shared<btMultiSphereShape>(centers, radii, 2);
}

ShapePtr convexFrom(Bytes& bytes, btScalar size) {
  const btScalar radius = lengthFrom(bytes, size);
  switch (bytes.below(7)) {
    case 0:
      return std::make_shared<btBoxShape>(halfExtentsFrom(bytes, size));
    case 1:
      return std::make_shared<btSphereShape>(radius);
    case 2:
      return std::make_shared<btCapsuleShape>(radius, lengthFrom(bytes, size));
    case 3:
      return std::make_shared<btCylinderShape>(halfExtentsFrom(bytes, size));
    case 4:
      return std::make_shared<btConeShape>(radius, lengthFrom(bytes, size));
    case 5:
      return ballsFrom(bytes, size);
    default:
      return hullFrom(bytes, size);
  }
}

/// Any triangles, now and then one without area; or a level floor of some.
std::vector<btVector3> cornersFrom(Bytes& bytes, btScalar size) {
  std::vector<btVector3> corners;
  for (std::uint32_t i = 1 + bytes.below(12); i > 0; --i) {
    for (int k = 0; k < 3; ++k) corners.push_back(pointFrom(bytes, size));
    if (bytes.below(8) == 1) corners.back() = *(corners.end() - 2);
  }
  if (bytes.below(3) == 0)
    for (btVector3& corner : corners) corner.setZ(0);
  return corners;
}

ShapePtr gimpactFrom(Bytes& bytes, btScalar size) {
  auto owned = std::make_shared<test::OwnedMesh>();
  const std::vector<btVector3> corners = cornersFrom(bytes, size);
  for (std::size_t i = 0; i < corners.size(); i += 3)
    owned->mesh.addTriangle(corners[i], corners[i + 1], corners[i + 2]);
  auto shape = std::make_shared<btGImpactMeshShape>(&owned->mesh);
  shape->updateBound();
  return {shape.get(), [owned, shape](btCollisionShape*) {}};
}

ShapePtr heightFieldFrom(Bytes& bytes, btScalar size) {
  const int columns = 2 + int(bytes.below(4)), rows = 2 + int(bytes.below(4));
  auto heights = std::make_shared<std::vector<btScalar>>();
  for (int i = 0; i < columns * rows; ++i) heights->push_back(size * btScalar(bytes.between(-1, 1)));
  auto shape = std::make_shared<btHeightfieldTerrainShape>(columns, rows, heights->data(), btScalar(1), -size, size, 2,
                                                           PHY_FLOAT, bytes.below(2) == 1);
  shape->setLocalScaling(btVector3(size, size, 1));
  return {shape.get(), [heights, shape](btCollisionShape*) {}};
}

ShapePtr terrainFrom(Bytes& bytes, btScalar size) {
  std::mt19937_64 engine(bytes.next());
  const test::TerrainSize cells{2 + bytes.below(6), 2 + bytes.below(6), double(size)};
  bullet::TerrainGrid grid = test::randomTerrain(engine, cells, bytes.below(4) == 1 ? 100 : 0);
  grid.diagonals = test::kEveryDiagonals[bytes.below(3)];
  auto shape = bullet::TerrainShape::create(std::move(grid));
  if (shape) return std::move(shape).value();
  requireSentence(shape.error().message);
  return std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0));
}

ShapePtr fixedFrom(Bytes& bytes, btScalar size) {
  switch (bytes.below(7)) {
    case 0:
      return std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), lengthFrom(bytes, size));
    case 1: {
      const btVector3 normal = pointFrom(bytes, 1) + btVector3(0, 0, btScalar(1e-3));
      return std::make_shared<btStaticPlaneShape>(normal.normalized(), lengthFrom(bytes, size));
    }
    case 2:
      return test::meshOf(cornersFrom(bytes, size));
    case 3:
      return gimpactFrom(bytes, size);
    case 4:
      return heightFieldFrom(bytes, size);
    case 5:
      return terrainFrom(bytes, size);
    default:
      return test::fieldShape({{-1, -1, -1}, {1, 1, 1}, {3, 3, 3}}, test::boxDistance({0.5, 0.4, 0.3}));
  }
}

// Of trees alone: where anything else meets a non-finite body, Bullet hands it on.
MadeShape compoundFrom(Bytes& bytes, int mostPowerOfTen, bool mayBeDamaged, int depth) {
  auto compound = std::make_shared<btCompoundShape>();
  std::vector<ShapePtr> children;
  MadeShape made;
  const auto add = [&](ShapePtr child) {
    const btQuaternion turn{pointFrom(bytes, 1) + btVector3(0, 0, 2), btScalar(bytes.between(0, 3))};
    compound->addChildShape(btTransform(turn, pointFrom(bytes, 1)), child.get());
    children.push_back(std::move(child));
  };
  const MadeShape tree = depth > 0 && bytes.below(3) == 0 ? compoundFrom(bytes, mostPowerOfTen, mayBeDamaged, depth - 1)
                                                          : treeShapeFrom(bytes, mostPowerOfTen, mayBeDamaged);
  add(tree.shape);
  if (bytes.below(2) == 0) add(treeShapeFrom(bytes, mostPowerOfTen, false).shape);
  made.shape = {compound.get(), [children = std::move(children), compound](btCollisionShape*) {}};
  made.hasTree = true;
  made.isHonest = tree.isHonest;
  return made;
}

}  // namespace

double scaleFrom(Bytes& bytes, int mostPowerOfTen) {
  const double power = bytes.powerOfTen(mostPowerOfTen);
  return power * bytes.between(1, 2);
}

MadeShape treeShapeFrom(Bytes& bytes, int mostPowerOfTen, bool mayBeDamaged) {
  MadeShape made;
  made.hasTree = true;
  std::shared_ptr<const SphereTree> tree;
  if (mayBeDamaged && bytes.below(4) == 1) tree = damagedTreeFrom(bytes);
  made.isHonest = !tree;
  if (!tree) tree = solidTrees()[bytes.below(std::uint32_t(solidTrees().size()))].tree;
  const auto frame = bytes.below(2) == 0 ? bullet::BodyFrame::principalAxes : bullet::BodyFrame::mesh;
  const auto scale = btScalar(scaleFrom(bytes, mostPowerOfTen));
  auto shape = bullet::SphereTreeShape::create(tree, frame, scale);
  if (!shape) {
    requireSentence(shape.error().message);
    require(!made.isHonest, "a sound tree's shape was refused");
    made.isHonest = true;
    shape = bullet::SphereTreeShape::create(solidTrees().front().tree, frame, scale);
  }
  if (bytes.below(8) == 1) shape.value()->setMargin(scale * btScalar(0.1 * bytes.part()));
  made.tree = shape.value().get();
  made.shape = std::move(shape).value();
  return made;
}

MadeShape shapeFrom(Bytes& bytes, int mostPowerOfTen, bool mayBeDamaged) {
  const std::uint32_t kind = bytes.below(8);
  if (kind < 4) return treeShapeFrom(bytes, mostPowerOfTen, mayBeDamaged);
  if (kind == 4) return compoundFrom(bytes, mostPowerOfTen, mayBeDamaged, 2);
  const auto size = btScalar(scaleFrom(bytes, mostPowerOfTen));
  if (kind == 5) return {fixedFrom(bytes, size), nullptr, false, true, true};
  return {convexFrom(bytes, size), nullptr, false, bytes.below(2) == 0, true};
}

}  // namespace cairn::fuzz
