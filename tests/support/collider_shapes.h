// SPDX-License-Identifier: Zlib
#pragma once

#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "distance_fields.h"
#include "gimpact_mesh.h"
#include "still_scenes.h"
#include "triangle_grounds.h"

namespace cairn::test {

/// Makes a tree of a solid: by the builder, or plainly where there is none.
using TreeOf = std::function<std::shared_ptr<const SphereTree>(const Solid&)>;

/// Something fixed to lie on, and to go down. Its top is level, six metres or more to every side, or bends away evenly.
struct TriedGround {
  std::string name;
  std::shared_ptr<btCollisionShape> shape;
  btScalar top = 0;     ///< of its surface, margin included, over its origin, metres
  btScalar margin = 0;  ///< of a mesh's triangles: Bullet's shapes keep it, trees touch the triangles
  double bend = 0;      ///< radius of the circle its top follows downhill, metres; 0: it is flat
  btQuaternion turned = btQuaternion::getIdentity();
};

/// Something to set down: as it stands it slides, and what is round rolls as well.
struct TriedMover {
  std::string name;
  TriedBody body;
  btScalar height = 0;  ///< of its centre over what it lies on, metres, margin left out
  double radius = 0;    ///< of what rolls, about its y once turned; else 0
  btQuaternion turned = btQuaternion::getIdentity();
  int facets = 0;           ///< around what rolls, if it is no true circle; else 0
  btScalar meshMargin = 0;  ///< of a mesh's triangles: Bullet's shapes keep it, trees touch the triangles
};

namespace detail {

inline std::shared_ptr<btCollisionShape> hullOfCuboid(const btVector3& half, btScalar margin) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (int corner = 0; corner < 8; ++corner)
    hull->addPoint(half * btVector3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
  hull->setMargin(margin);
  return hull;
}

/// A compound of one or more children, who live as long as it does.
inline std::shared_ptr<btCollisionShape> compoundOf(
    std::vector<std::pair<btVector3, std::shared_ptr<btCollisionShape>>> children) {
  auto compound = std::make_unique<btCompoundShape>();
  for (const auto& [at, child] : children)
    compound->addChildShape(btTransform(btQuaternion::getIdentity(), at), child.get());
  btCompoundShape* const shape = compound.get();
  return {shape, [children = std::move(children),
                  owner = std::shared_ptr<btCompoundShape>(std::move(compound))](btCollisionShape*) {}};
}

inline std::shared_ptr<btCollisionShape> scaledConvex(std::shared_ptr<btConvexShape> child, btScalar factor) {
  auto scaled = std::make_unique<btUniformScalingShape>(child.get(), factor);
  btCollisionShape* const shape = scaled.get();
  return {shape, [child = std::move(child),
                  owner = std::shared_ptr<btCollisionShape>(std::move(scaled))](btCollisionShape*) {}};
}

inline const btQuaternion kYUp{btVector3(1, 0, 0), btScalar(std::numbers::pi / 2)};  // takes y to z, and z to -y

// A slab of a metre, in a domain that reaches as far above and below it, in cells of about half a metre.
inline std::shared_ptr<btCollisionShape> fieldSlab() {
  return fieldShape({{-9, -9, -1.5}, {9, 9, 1.5}, {36, 36, 6}}, boxDistance({8, 8, 0.5}));
}

}  // namespace detail

/// A box, and what is level like one: the ground beside which others are judged.
inline TriedGround boxGround() {
  return {"box", std::make_shared<btBoxShape>(btVector3(8, 8, btScalar(0.5))), btScalar(0.5)};
}

/// The shapes that a tree can lie on, each as Bullet offers it.
inline std::vector<TriedGround> everyGround(const TreeOf& treeOf) {
  constexpr btScalar kRound = 100, kMargin = btScalar(0.001);
  const btVector3 half(8, 8, btScalar(0.5));
  const auto mesh = [&](TriangleGround kind) {
    auto shape = flatGround(kind);
    shape->setMargin(kMargin);
    return shape;
  };
  auto materials = flatGroundOfMaterials();
  materials->setMargin(kMargin);
  const auto tile = std::make_shared<btBoxShape>(btVector3(4, 4, btScalar(0.5)));
  const btVector3 centers[2] = {btVector3(0, -1, 0), btVector3(0, 1, 0)};
  const btScalar radii[2] = {kRound, kRound};
  const auto slab = treeOf(cuboid({16, 16, 1}, 8));
  return {
      {"plane", std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0))},
      boxGround(),
      {"sphere", std::make_shared<btSphereShape>(kRound), kRound, 0, kRound},
      {"capsule", std::make_shared<btCapsuleShape>(kRound, 8), kRound, 0, kRound},
      {"cylinder", std::make_shared<btCylinderShapeZ>(half), btScalar(0.5)},
      // On its tip: a cone's axis is y. Its margin comes on top.
      {"cone", std::make_shared<btConeShape>(btScalar(8), btScalar(4)), 2 + btScalar(CONVEX_DISTANCE_MARGIN), 0, 0,
       detail::kYUp.inverse()},
      {"hull", detail::hullOfCuboid(half, btScalar(0.01)), btScalar(0.51)},
      {"multi-sphere", std::make_shared<btMultiSphereShape>(centers, radii, 2), kRound, 0, kRound},
      {"scaled convex", detail::scaledConvex(std::make_shared<btBoxShape>(half * btScalar(0.5)), 2), btScalar(0.5)},
      {"mesh", mesh(TriangleGround::mesh), kMargin, kMargin},
      {"scaled mesh", mesh(TriangleGround::scaledMesh), kMargin, kMargin},
      {"materials' mesh", materials, kMargin, kMargin},
      {"height field", mesh(TriangleGround::terrain), kMargin, kMargin},
      {"compound",
       detail::compoundOf({{btVector3(-4, -4, 0), tile},
                           {btVector3(4, -4, 0), tile},
                           {btVector3(-4, 4, 0), tile},
                           {btVector3(4, 4, 0), tile}}),
       btScalar(0.5)},
      {"GImpact", mesh(TriangleGround::gimpact), kMargin, kMargin},
      {"field", detail::fieldSlab(), btScalar(0.5)},
      {"tree", treeShape(slab), btScalar(0.5)},
      {"scaled tree", treeShape(treeOf(cuboid({8, 8, 0.5}, 8)), 2), btScalar(0.5)},
      {"tree in compound", detail::compoundOf({{btVector3(0, 0, 0), treeShape(slab)}}), btScalar(0.5)},
  };
}

/// A block, a metre long.
inline constexpr double kBlock[3] = {1, 0.4, 0.3};
inline Solid block() {
  return cuboid({kBlock[0], kBlock[1], kBlock[2]}, 4);
}
inline TriedMover blockMover(std::string name, std::shared_ptr<btCollisionShape> shape, btScalar margin = 0) {
  const btVector3 square(btScalar(kBlock[0] * kBlock[0]), btScalar(kBlock[1] * kBlock[1]),
                         btScalar(kBlock[2] * kBlock[2]));
  const btVector3 inertia =
      btVector3(square[1] + square[2], square[0] + square[2], square[0] + square[1]) / btScalar(12);
  return {std::move(name), {std::move(shape), inertia, margin}, btScalar(kBlock[2] / 2)};
}

/// Radius of what rolls.
inline constexpr double kRoller = 0.2;
inline TriedMover ballMover(std::string name, std::shared_ptr<btCollisionShape> shape, btScalar margin = 0) {
  const btScalar moment = btScalar(0.4 * kRoller * kRoller);
  return {std::move(name), {std::move(shape), btVector3(moment, moment, moment), margin}, kRoller, kRoller};
}
inline constexpr int kBallSubdivisions = 16;

inline TriedMover treeBlock(const TreeOf& treeOf) {
  return blockMover("tree", treeShape(treeOf(block())));
}
inline TriedMover treeBall(const TreeOf& treeOf) {
  TriedMover ball = ballMover("tree", treeShape(treeOf(test::ball(kRoller, kBallSubdivisions))));
  ball.facets = 4 * kBallSubdivisions;
  return ball;
}
inline TriedMover boxBlock() {
  return blockMover("box", std::make_shared<btBoxShape>(
                               btVector3(btScalar(kBlock[0]), btScalar(kBlock[1]), btScalar(kBlock[2])) / 2));
}
inline TriedMover sphereBall() {
  return ballMover("sphere", std::make_shared<btSphereShape>(btScalar(kRoller)));
}

/// Everything of Bullet's that can move, to be set down on a tree.
inline std::vector<TriedMover> everyMover(const TreeOf& treeOf) {
  constexpr btScalar kHullMargin = btScalar(0.01), kGimpactMargin = btScalar(0.001);
  const btVector3 half = btVector3(btScalar(kBlock[0]), btScalar(kBlock[1]), btScalar(kBlock[2])) / 2;
  const btScalar r = btScalar(kRoller), h = btScalar(0.4);
  const btVector3 centers[2] = {btVector3(0, btScalar(-0.2), 0), btVector3(0, btScalar(0.2), 0)};
  const btScalar radii[2] = {r, r};
  const auto rollerOf = [&](std::string name, std::shared_ptr<btCollisionShape> shape) {
    TriedMover mover = ballMover(std::move(name), std::move(shape));
    mover.body.inertia[0] = mover.body.inertia[2] = btScalar(0.03);
    return mover;
  };
  TriedMover standing = rollerOf("cylinder, standing", std::make_shared<btCylinderShape>(btVector3(r, r, r)));
  standing.turned = detail::kYUp;
  standing.radius = 0;
  TriedMover cone = rollerOf("cone, standing", std::make_shared<btConeShape>(2 * r, h));
  cone.turned = detail::kYUp;
  cone.radius = 0;
  cone.height = h / 2 + btScalar(CONVEX_DISTANCE_MARGIN);
  const auto small = std::make_shared<btBoxShape>(half * btVector3(btScalar(0.5), 1, 1));
  const auto blockTree = treeOf(block());
  TriedMover gimpact = blockMover("GImpact", gimpactMesh(block(), kGimpactMargin), kGimpactMargin);
  gimpact.meshMargin = kGimpactMargin;
  return {
      boxBlock(),
      sphereBall(),
      rollerOf("capsule", std::make_shared<btCapsuleShape>(r, h)),
      rollerOf("cylinder", std::make_shared<btCylinderShape>(btVector3(r, h, r))),
      standing,
      cone,
      blockMover("hull", detail::hullOfCuboid(half, kHullMargin), kHullMargin),
      rollerOf("multi-sphere", std::make_shared<btMultiSphereShape>(centers, radii, 2)),
      ballMover("scaled convex", detail::scaledConvex(std::make_shared<btSphereShape>(r / 2), 2)),
      blockMover("compound",
                 detail::compoundOf({{btVector3(half.x() / -2, 0, 0), small}, {btVector3(half.x() / 2, 0, 0), small}})),
      gimpact,
      treeBlock(treeOf),
      blockMover("scaled tree", treeShape(treeOf(cuboid({kBlock[0] / 2, kBlock[1] / 2, kBlock[2] / 2}, 4)), 2)),
      blockMover("tree in compound", detail::compoundOf({{btVector3(0, 0, 0), treeShape(blockTree)}})),
      treeBall(treeOf),
  };
}

}  // namespace cairn::test
