// SPDX-License-Identifier: Zlib
// Bullet's own meshes as surfaces: which are closed, on which side of them a body is, and what becomes of those that
// change.
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <gtest/gtest.h>

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

TEST(GroundSurface, IsOfClosedPieces) {
  std::vector<btVector3> corners = cornersOf(cuboid({1, 1, 1}, 2));
  const std::size_t triangles = corners.size() / 3;
  const std::vector<btVector3> second = cornersOf(cuboid({1, 1, 1}, 2), {3, 0, 0});
  corners.insert(corners.end(), second.begin(), second.end() - 3);  // but for one of its triangles
  const auto shape = meshOf(corners);
  const auto surface = GroundSurface::of(concave(shape));
  ASSERT_TRUE(surface);
  EXPECT_EQ(surface->view(false).vertices.size(), 2U * 26);
  const TriangleSoup soup = soupOf(concave(shape));
  ASSERT_EQ(soup.triangles().size(), corners.size() / 3);
  for (const TriangleSoup::Source& source : soup.triangles()) {
    const std::uint32_t triangle = surface->triangleOf(source);
    ASSERT_NE(triangle, GroundSurface::kNone);
    const bool isOfFirst = source.corners[0].x() < 1;
    EXPECT_EQ(surface->isClosed(surface->pieceOf(triangle)), isOfFirst);
    EXPECT_EQ(surface->pieceOf(triangle), isOfFirst ? surface->pieceOf(0) : surface->pieceOf(std::uint32_t(triangles)));
  }
}

TEST(GroundSurface, IsSharedAndKnowsWhatIsNoLongerIts) {
  const auto shape = meshOf(cornersOf(cuboid({1, 1, 1}, 1)));
  const auto surface = GroundSurface::of(concave(shape));
  EXPECT_EQ(surface, GroundSurface::of(concave(shape)));
  const TriangleSoup soup = soupOf(concave(shape));
  TriangleSoup::Source source = soup.triangles().front();
  EXPECT_NE(surface->triangleOf(source), GroundSurface::kNone);
  source.corners[1] += btVector3(0, 0, btScalar(1e-3));
  EXPECT_EQ(surface->triangleOf(source), GroundSurface::kNone);
  EXPECT_FALSE(GroundSurface::of(concave(std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)))));
}

// Neither of a triangle whose neighbour is wound the other way, nor of an edge with three of them.
TEST(GroundSurface, IsOpenWhereFacesDoNotAgree) {
  std::vector<btVector3> turned = cornersOf(cuboid({1, 1, 1}, 1));
  std::swap(turned[1], turned[2]);
  std::vector<btVector3> finned = cornersOf(cuboid({1, 1, 1}, 1));
  finned.insert(finned.end(), {finned[0], finned[1], btVector3(3, 3, 3)});
  for (const std::vector<btVector3>& corners : {turned, finned}) {
    const auto shape = meshOf(corners);
    const auto surface = GroundSurface::of(concave(shape));
    const TriangleSoup soup = soupOf(concave(shape));
    for (const TriangleSoup::Source& source : soup.triangles())
      EXPECT_FALSE(surface->isClosed(surface->pieceOf(surface->triangleOf(source))));
  }
}

// A room's walls may show outwards or inwards, and a box's too: a body stays where it was put.
TEST(MeshGround, HoldsFromBothSidesHoweverItIsWound) {
  for (const bool isTurned : {false, true})
    for (const bool isInside : {false, true}) {
      std::vector<btVector3> corners = cornersOf(cuboid({4, 4, 4}, 3));
      for (std::size_t i = 0; isTurned && i < corners.size(); i += 3) std::swap(corners[i + 1], corners[i + 2]);
      BulletWorld<> w;
      w.add(meshOf(corners), 0, btVector3(0, 0, 0));
      const double floor = isInside ? -2 : 2;
      btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 2))), 1,
                                btVector3(btScalar(0.1), btScalar(0.2), btScalar(floor + 0.7)));
      body.setActivationState(DISABLE_DEACTIVATION);
      w.step(180);
      EXPECT_NEAR(double(body.getWorldTransform().getOrigin().z()), floor + 0.5, 0.004)
          << "turned " << isTurned << ", inside " << isInside;
      EXPECT_EQ(w.dispatcher.lastStep().exactContacts, w.dispatcher.lastStep().contacts);
      EXPECT_GE(w.dispatcher.lastStep().contacts, 3U);
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
