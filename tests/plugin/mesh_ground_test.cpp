// SPDX-License-Identifier: Zlib
// Bullet's own meshes as surfaces: which of them are solids, who is inside, and what becomes of those that change.
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <gtest/gtest.h>

#include <limits>

#include "bullet_world.h"
#include "placement/bullet_math.h"
#include "triangle_grounds.h"
#include "triangles/ground_surface.h"

namespace cairn::test::mesh_ground_test {
namespace {

using bullet::GroundSurface;
using bullet::TriangleSoup;

const btConcaveShape& concave(const std::shared_ptr<btCollisionShape>& shape) {
  return static_cast<const btConcaveShape&>(*shape);
}

TriangleSoup soupOf(const btConcaveShape& shape) {
  TriangleSoup soup;
  soup.gather(shape, btVector3(-9, -9, -9), btVector3(9, 9, 9));
  return soup;
}

// Every corner by itself, as meshes for drawing have them.
std::vector<btVector3> cornersOf(const Solid& solid, const Vec3d& at = {}) {
  std::vector<btVector3> corners;
  for (const auto& t : solid.triangles)
    for (const std::uint32_t v : t) corners.push_back(bullet::toBullet(solid.vertices[v] + at));
  return corners;
}

bool isSolid(const std::vector<btVector3>& corners) {
  const auto shape = meshOf(corners);
  return GroundSurface::of(concave(shape))->isSolid();
}

TEST(GroundSurface, IsOfOneSolid) {
  const std::vector<btVector3> solid = cornersOf(cuboid({1, 1, 1}, 2));
  const auto shape = meshOf(solid);  // lives on: by its place another would be taken for it
  const auto surface = GroundSurface::of(concave(shape));
  ASSERT_TRUE(surface->isSolid());
  EXPECT_EQ(surface->view().vertices.size(), 26U);
  EXPECT_NEAR(surface->view().derived->thickness, 1, 1e-5);
  std::vector<btVector3> open = solid, turned = solid, finned = solid, two = solid, insideOut = solid;
  open.resize(open.size() - 3);
  std::swap(turned[1], turned[2]);
  finned.insert(finned.end(), {finned[0], finned[1], btVector3(3, 3, 3)});
  const std::vector<btVector3> second = cornersOf(cuboid({1, 1, 1}, 2), {3, 0, 0});
  two.insert(two.end(), second.begin(), second.end());
  for (std::size_t i = 0; i < insideOut.size(); i += 3) std::swap(insideOut[i + 1], insideOut[i + 2]);
  for (const auto& corners : {open, turned, finned, two, insideOut}) EXPECT_FALSE(isSolid(corners));
  std::vector<btVector3> withNan = solid;
  withNan[4].setX(std::numeric_limits<btScalar>::quiet_NaN());
  EXPECT_FALSE(isSolid(withNan));
}

TEST(GroundSurface, IsNotOfHugeMeshes) {
  EXPECT_TRUE(isSolid(cornersOf(cuboid({1, 1, 1}, 40))));
  EXPECT_FALSE(isSolid(cornersOf(cuboid({1, 1, 1}, 130)))) << "202,800 triangles";
}

TEST(GroundSurface, IsSharedAndKnowsWhatIsNoLongerIts) {
  const auto shape = meshOf(cornersOf(cuboid({1, 1, 1}, 1)));
  const auto surface = GroundSurface::of(concave(shape));
  EXPECT_EQ(surface, GroundSurface::of(concave(shape)));
  const TriangleSoup soup = soupOf(concave(shape));
  for (TriangleSoup::Source source : soup.triangles()) {
    EXPECT_NE(surface->triangleOf(source), GroundSurface::kNone);
    source.corners[1] += btVector3(0, 0, btScalar(1e-3));
    EXPECT_EQ(surface->triangleOf(source), GroundSurface::kNone);
  }
  EXPECT_FALSE(GroundSurface::of(concave(std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)))));
}

// A room's walls may show outwards or inwards, and a box's too: a body stays where it was put. In a room, on the floor
// in each of its corners.
TEST(MeshGround, HoldsFromBothSides) {
  for (const bool isTurned : {false, true})
    for (const bool isInside : {false, true})
      for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0}) {
          std::vector<btVector3> corners = cornersOf(cuboid({4, 4, 4}, 3));
          for (std::size_t i = 0; isTurned && i < corners.size(); i += 3) std::swap(corners[i + 1], corners[i + 2]);
          BulletWorld<> w;
          w.add(meshOf(corners), 0, btVector3(0, 0, 0));
          const double floor = isInside ? -2 : 2;
          btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 2))), 1,
                                    btVector3(btScalar(1.49 * x), btScalar(1.49 * y), btScalar(floor + 0.7)));
          body.setActivationState(DISABLE_DEACTIVATION);
          w.step(180);
          EXPECT_NEAR(double(body.getWorldTransform().getOrigin().z()), floor + 0.5, 0.004)
              << "turned " << isTurned << ", inside " << isInside << ", corner " << x << ", " << y;
          EXPECT_GE(w.dispatcher.lastStep().contacts, 3U);
          const bool isOfSurfaces = !isTurned && !isInside;
          EXPECT_EQ(w.dispatcher.lastStep().exactContacts, isOfSurfaces ? w.dispatcher.lastStep().contacts : 0U);
        }
}

// A body faster than half its thickness a step may be mostly through the surface when it first comes near.
TEST(MeshGround, IsNotPassedByWhatIsMostlyThroughIt) {
  const struct {
    Vec3d size;
    double fall;
  } all[] = {{{1, 1, 0.03}, 0.12}, {{0.1, 0.1, 0.1}, 1}};
  for (const auto& thrown : all) {
    const auto shape = treeShape(plainTree(cuboid(thrown.size, 4)));
    for (int phase = 0; phase < 20; ++phase) {
      BulletWorld<> w;
      w.add(bvhMesh(cuboid({4, 4, 1}, 2)), 0, btVector3(0, 0, 0));
      const double height = 0.5 + thrown.size.z / 2 + thrown.fall * (1 + 0.01 * phase);
      btRigidBody& body = w.add(shape, 1, btVector3(btScalar(0.1), btScalar(0.2), btScalar(height)));
      w.step(180);
      EXPECT_NEAR(double(body.getWorldTransform().getOrigin().z()), 0.5 + thrown.size.z / 2, 0.004)
          << thrown.size.z << " m thick, phase " << phase;
    }
  }
}

// As an application does that digs: new heights in the same array, and the shape told so.
TEST(MeshGround, IsFollowedWhereItChanges) {
  const Solid solid = cuboid({4, 4, 1}, 2);
  btTriangleMesh mesh;
  for (const auto& t : solid.triangles)
    mesh.addTriangle(bullet::toBullet(solid.vertices[t[0]]), bullet::toBullet(solid.vertices[t[1]]),
                     bullet::toBullet(solid.vertices[t[2]]), true);
  const auto shape = std::make_shared<btBvhTriangleMeshShape>(&mesh, false);
  BulletWorld<> w;
  w.add(shape, 0, btVector3(0, 0, 0));
  btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 2))), 1, btVector3(0, 0, btScalar(1.001)));
  body.setActivationState(DISABLE_DEACTIVATION);
  w.step(60);
  EXPECT_EQ(w.dispatcher.lastStep().exactContacts, w.dispatcher.lastStep().contacts);
  EXPECT_NEAR(double(body.getWorldTransform().getOrigin().z()), 1, 0.004);
  unsigned char *vertices = nullptr, *indices = nullptr;
  int count = 0, stride = 0, indexStride = 0, faces = 0;
  PHY_ScalarType type = PHY_FLOAT, indexType = PHY_INTEGER;
  mesh.getLockedVertexIndexBase(&vertices, count, type, stride, &indices, indexStride, faces, indexType);
  for (int i = 0; i < count; ++i) {
    auto* const place = reinterpret_cast<btScalar*>(vertices + i * stride);
    if (place[2] > 0) place[2] -= btScalar(0.2);
  }
  mesh.unLockVertexBase(0);
  btVector3 lower, upper;
  shape->getAabb(btTransform::getIdentity(), lower, upper);
  shape->refitTree(lower, upper);
  w.step(120);
  EXPECT_NEAR(double(body.getWorldTransform().getOrigin().z()), 0.8, 0.004);
}

}  // namespace
}  // namespace cairn::test::mesh_ground_test
