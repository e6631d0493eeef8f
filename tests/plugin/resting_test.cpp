// SPDX-License-Identifier: Zlib
// A body comes to rest where its mesh touches what lies below, whatever that is and in whichever order Bullet meets
// them.
#include <gtest/gtest.h>

#include <numbers>

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>

#include "distance_fields.h"
#include "front_ends.h"

namespace cairn::test::resting_test {
namespace {

// A body at rest lies between the speculative distance above the ground and Bullet's own allowance below it (ERP 0.2
// leaves a steady few tenths of a millimetre; linear slop 0).
constexpr btScalar kRestTolerance = bullet::kSpeculativeFraction;

enum class Ground { plane, box, sphereCap, capsule, cylinder, hull, mesh, scaledMesh, terrain, tree, field };

std::shared_ptr<btCollisionShape> meshShape(btScalar stretch) {
  // Ten by ten metres in a hundred cells, so that the body rests across many edges.
  static btTriangleMesh mesh;
  if (mesh.getNumTriangles() == 0)
    for (int i = -5; i < 5; ++i)
      for (int j = -5; j < 5; ++j) {
        const btVector3 a(i, j, 0), b(i + 1, j, 0), c(i + 1, j + 1, 0), d(i, j + 1, 0);
        mesh.addTriangle(a, b, c);
        mesh.addTriangle(a, c, d);
      }
  auto shape = std::make_shared<btBvhTriangleMeshShape>(&mesh, true);
  if (stretch == 1) return shape;
  static std::vector<std::shared_ptr<btBvhTriangleMeshShape>> kept;
  kept.push_back(shape);
  return std::make_shared<btScaledBvhTriangleMeshShape>(shape.get(), btVector3(stretch, stretch, stretch));
}

std::shared_ptr<btCollisionShape> terrainShape() {
  // Bullet's double-precision build reads PHY_FLOAT heights as doubles.
  static const std::vector<btScalar> heights(64, btScalar(0));
  auto shape = std::make_shared<btHeightfieldTerrainShape>(8, 8, heights.data(), 1, -1, 1, 2, PHY_FLOAT, false);
  return shape;
}

std::shared_ptr<btCollisionShape> hullShape() {
  auto hull = std::make_shared<btConvexHullShape>();
  for (int corner = 0; corner < 8; ++corner)
    hull->addPoint(btVector3(corner & 1 ? 3 : -3, corner & 2 ? 3 : -3, corner & 4 ? 1 : -1));
  hull->setMargin(btScalar(0.01));
  return hull;
}

// Half a metre of a slab below height 0, whose faces run between those of the grid's cells.
std::shared_ptr<btCollisionShape> fieldSlab() {
  static const auto shape = fieldShape({{-2.5, -2.5, -1}, {2.5, 2.5, 1}, {11, 11, 9}}, boxDistance({2, 2, 0.5}));
  return shape;
}

// Adds the ground with its top at height 0.
template <class World>
void addGround(World& w, Ground ground) {
  switch (ground) {
    case Ground::plane:
      w.addGround();
      return;
    case Ground::box:
      w.add(std::make_shared<btBoxShape>(btVector3(5, 5, 1)), 0, btVector3(0, 0, -1));
      return;
    case Ground::sphereCap:
      w.add(std::make_shared<btSphereShape>(50), 0, btVector3(0, 0, -50));
      return;
    case Ground::capsule:
      w.add(std::make_shared<btCapsuleShapeX>(20, 40), 0, btVector3(0, 0, -20));
      return;
    case Ground::cylinder:
      w.add(std::make_shared<btCylinderShapeZ>(btVector3(4, 4, 1)), 0, btVector3(0, 0, -1));
      return;
    case Ground::hull:
      w.add(hullShape(), 0, btVector3(0, 0, btScalar(-1.01)));
      return;
    case Ground::mesh:
      w.add(meshShape(1), 0, btVector3(btScalar(0.3), btScalar(0.2), 0));
      return;
    case Ground::scaledMesh:
      w.add(meshShape(btScalar(0.5)), 0, btVector3(btScalar(0.3), btScalar(0.2), 0));
      return;
    case Ground::terrain:
      w.add(terrainShape(), 0, btVector3(0, 0, 0));
      return;
    case Ground::tree:
      w.add(treeShape(plainTree(cuboid({4, 4, 1}, 8))), 0, btVector3(0, 0, btScalar(-0.5)));
      return;
    case Ground::field:
      w.add(fieldSlab(), 0, btVector3(0, 0, btScalar(-0.5)));
      return;
  }
}

class Resting : public testing::TestWithParam<std::tuple<Ground, bool, FrontEnd>> {};

TEST_P(Resting, CuboidLiesWhereItsMeshTouches) {
  inWorldOf(std::get<2>(GetParam()), [&](auto& w) {
    const auto [ground, groundFirst, frontEnd] = GetParam();
    const Vec3d size{0.6, 0.5, 0.4};
    const auto shape = treeShape(plainTree(cuboid(size, 4)));
    btRigidBody* body = nullptr;
    const btVector3 start(btScalar(0.05), btScalar(0.03), btScalar(0.5 * size.z + 0.05));
    if (!groundFirst) body = &w.add(shape, 1, start);
    addGround(w, ground);
    if (groundFirst) body = &w.add(shape, 1, start);
    w.step(180);
    ASSERT_TRUE(isSane(*body));
    const btScalar height = body->getWorldTransform().getOrigin().z() - btScalar(0.5 * size.z);
    EXPECT_NEAR(height, 0, kRestTolerance) << "ground " << static_cast<int>(ground);
    EXPECT_LT(body->getLinearVelocity().length(), 0.01);
    EXPECT_GT(body->getWorldTransform().getBasis()[2][2], 0.999) << "tilted";
    EXPECT_NEAR(body->getWorldTransform().getOrigin().x(), start.x(), 0.02) << "slid or tripped";
  });
}

TEST_P(Resting, BallLiesWhereItsMeshTouches) {
  inWorldOf(std::get<2>(GetParam()), [&](auto& w) {
    const auto [ground, groundFirst, frontEnd] = GetParam();
    const auto shape = treeShape(plainTree(ball(0.3, 10)));
    btRigidBody* body = nullptr;
    const btVector3 start(0, 0, btScalar(0.33));
    if (!groundFirst) body = &w.add(shape, 1, start);
    addGround(w, ground);
    if (groundFirst) body = &w.add(shape, 1, start);
    w.step(180);
    ASSERT_TRUE(isSane(*body));
    // The inscribed polyhedron lies lower than the ball by at most the sagitta of one facet: a facet spans 9 degrees.
    const btScalar sagitta = btScalar(0.3 * (1 - std::cos(0.5 * std::numbers::pi / 2 / 10 * 1.6)));
    const btScalar height = body->getWorldTransform().getOrigin().z() - btScalar(0.3);
    EXPECT_LT(height, kRestTolerance);
    EXPECT_GT(height, -sagitta - kRestTolerance);
  });
}

INSTANTIATE_TEST_SUITE_P(AllGrounds, Resting,
                         testing::Combine(testing::Values(Ground::plane, Ground::box, Ground::sphereCap,
                                                          Ground::capsule, Ground::cylinder, Ground::hull, Ground::mesh,
                                                          Ground::scaledMesh, Ground::terrain, Ground::tree,
                                                          Ground::field),
                                          testing::Bool(), testing::ValuesIn(kEveryFrontEnd)));

// A round ground under flat leaves far larger than the speculative distance: the plane that touches it below a leaf's
// centre rises above it everywhere else.
enum class Round { sphere, cylinder, gjkSphere };

std::shared_ptr<btCollisionShape> roundShape(Round ground) {
  if (ground == Round::sphere) return std::make_shared<btSphereShape>(btScalar(1));
  if (ground == Round::cylinder) return std::make_shared<btCylinderShapeX>(btVector3(1, 1, 1));
  const btVector3 center(0, 0, 0);
  const btScalar radius = 1;
  return std::make_shared<btMultiSphereShape>(&center, &radius, 1);
}

class RestingOnRound : public testing::TestWithParam<std::tuple<Round, int>> {
 protected:
  // A cube of one metre over a round ground of radius one, whose top is at height 0.
  static btRigidBody& addCube(BulletWorld<>& w, const btVector3& at) {
    const auto [ground, quads] = GetParam();
    w.add(roundShape(ground), 0, btVector3(0, 0, -1));
    return w.add(treeShape(plainTree(cuboid({1, 1, 1}, quads))), 1, at);
  }

  static constexpr btScalar kTolerance = kRestTolerance * btScalar(1.7320508);
};

TEST_P(RestingOnRound, CoarseLeavesDoNotFloat) {
  for (const btScalar aside : {btScalar(0), btScalar(0.1), btScalar(0.3)}) {
    BulletWorld<> w;
    btRigidBody& body = addCube(w, btVector3(0, aside, btScalar(0.56)));
    body.setLinearFactor(btVector3(0, 0, 1));
    body.setAngularFactor(btVector3(0, 0, 0));
    w.step(200);
    ASSERT_TRUE(isSane(body));
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z() - btScalar(0.5), 0, kTolerance) << aside << " m aside";
  }
}

// Distance between a cube of one metre and the ground of `RestingOnRound`: that of the cube from the ball's centre or
// the cylinder's axis, less the radius.
btScalar gapToRound(const btTransform& cube, Round ground) {
  btScalar nearest = 100;
  const btScalar reach = ground == Round::cylinder ? btScalar(1) : btScalar(0);
  for (btScalar x = -reach; x <= reach; x += btScalar(0.01)) {
    const btVector3 p = cube.inverse() * btVector3(x, 0, -1);
    btVector3 inside = p;
    inside.setMax(btVector3(-0.5, -0.5, -0.5));
    inside.setMin(btVector3(0.5, 0.5, 0.5));
    nearest = std::min(nearest, p.distance(inside));
  }
  return nearest - 1;
}

// On the top of a ball a cube may rock, roll and slide a little before it rests: the gap is judged where it ends up.
TEST_P(RestingOnRound, CubeStaysOnTop) {
  BulletWorld<> w;
  btRigidBody& body = addCube(w, btVector3(0, 0, btScalar(0.52)));
  w.step(300);
  ASSERT_TRUE(isSane(body));
  EXPECT_NEAR(gapToRound(body.getWorldTransform(), std::get<0>(GetParam())), 0, kTolerance);
  EXPECT_GT(body.getWorldTransform().getBasis()[2][2], 0.95) << "tipped";
  EXPECT_LT(body.getLinearVelocity().length(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Rounds, RestingOnRound,
                         testing::Combine(testing::Values(Round::sphere, Round::cylinder, Round::gjkSphere),
                                          testing::Values(1, 2, 3, 6)));

}  // namespace
}  // namespace cairn::test::resting_test
