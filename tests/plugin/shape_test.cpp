// SPDX-License-Identifier: Zlib
#include "cairn/bullet/sphere_tree_shape.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "bullet_world.h"
#include "random_tree.h"

namespace cairn::test::shape_test {
namespace {

using bullet::BodyFrame;
using bullet::SphereTreeShape;

btTransform randomTransform(std::mt19937_64& engine) {
  const Mat3d r = randomRotation(engine);
  const Vec3d p = randomPoint(engine) * 5;
  const btMatrix3x3 basis(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
  return btTransform(basis, btVector3(p.x, p.y, p.z));
}

TEST(SphereTreeShape_Aabb, HoldsTheMeshAndIsTight) {
  const Solid solid = twoCuboids({0.5, 0.4, 0.3}, {0.9, 0.2, 0.1}, 3);
  const auto shape = treeShape(plainTree(solid), btScalar(1.7));
  std::mt19937_64 engine(7);
  for (int trial = 0; trial < 200; ++trial) {
    const btTransform t = randomTransform(engine);
    btVector3 lower, upper, meshLower(1e9, 1e9, 1e9), meshUpper(-1e9, -1e9, -1e9);
    shape->getAabb(t, lower, upper);
    for (const Vec3d& v : solid.vertices) {
      const btVector3 p = t * shape->bodyFromMesh() * (btVector3(v.x, v.y, v.z) * shape->scale());
      meshLower.setMin(p);
      meshUpper.setMax(p);
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(lower[axis], meshLower[axis]);
      EXPECT_GE(upper[axis], meshUpper[axis]);
      EXPECT_GE(lower[axis], meshLower[axis] - btScalar(0.01) * shape->size());
      EXPECT_LE(upper[axis], meshUpper[axis] + btScalar(0.01) * shape->size());
    }
  }
}

TEST(SphereTreeShape_Aabb, GrowsByTheMargin) {
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 2)));
  btVector3 lower, upper, wideLower, wideUpper;
  shape->getAabb(btTransform::getIdentity(), lower, upper);
  shape->setMargin(btScalar(0.25));
  shape->getAabb(btTransform::getIdentity(), wideLower, wideUpper);
  EXPECT_NEAR((lower - wideLower).x(), 0.25, 1e-5);
  EXPECT_NEAR((wideUpper - upper).z(), 0.25, 1e-5);
}

// Bullet's own shapes leave none of a vector's four floats unset, and its world computes with all of them.
TEST(SphereTreeShape_Aabb, SetsAllFourFloats) {
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 1)));
  btVector3 lower, upper;
  for (btVector3* corner : {&lower, &upper}) corner->setW(std::numeric_limits<btScalar>::quiet_NaN());
  shape->getAabb(btTransform::getIdentity(), lower, upper);
  EXPECT_EQ(lower.w(), 0);
  EXPECT_EQ(upper.w(), 0);
}

TEST(SphereTreeShape_Inertia, IsTheCuboidsInBothFrames) {
  const Vec3d size{0.4, 1.0, 0.6};
  const auto tree = plainTree(cuboid(size, 2));
  const btScalar mass = 3, scale = 2;
  const Vec3d s = size * double(scale);
  const double x = mass / 12 * (s.y * s.y + s.z * s.z), y = mass / 12 * (s.x * s.x + s.z * s.z),
               z = mass / 12 * (s.x * s.x + s.y * s.y);
  btVector3 inertia;
  treeShape(tree, scale)->calculateLocalInertia(mass, inertia);
  EXPECT_NEAR(inertia.x(), x, 1e-4);
  EXPECT_NEAR(inertia.y(), y, 1e-4);
  EXPECT_NEAR(inertia.z(), z, 1e-4);
  const auto principal = SphereTreeShape::create(tree, BodyFrame::principalAxes, scale).value()->bodyFromMesh();
  SphereTreeShape::create(tree, BodyFrame::principalAxes, scale).value()->calculateLocalInertia(mass, inertia);
  EXPECT_NEAR(inertia.x(), y, 1e-4);  // ascending: the longest axis has the least moment
  EXPECT_NEAR(inertia.y(), z, 1e-4);
  EXPECT_NEAR(inertia.z(), x, 1e-4);
  EXPECT_NEAR(std::abs((principal.getBasis() * btVector3(0, 1, 0)).x()), 1, 1e-6);
}

// Whether some point of a fine grid on the triangle lies in the box.
bool reachesInto(const SphereTreeShape& shape, const Solid& solid, int triangle, const btVector3& lower,
                 const btVector3& upper) {
  const auto& t = solid.triangles[static_cast<std::size_t>(triangle)];
  constexpr int kGrid = 12;
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; i + j <= kGrid; ++j) {
      const Vec3d p = (solid.vertices[t[0]] * double(i) + solid.vertices[t[1]] * double(j) +
                       solid.vertices[t[2]] * double(kGrid - i - j)) /
                      double(kGrid);
      const btVector3 q = shape.bodyFromMesh() * (btVector3(p.x, p.y, p.z) * shape.scale());
      if (q.x() > lower.x() && q.y() > lower.y() && q.z() > lower.z() && q.x() < upper.x() && q.y() < upper.y() &&
          q.z() < upper.z())
        return true;
    }
  return false;
}

TEST(SphereTreeShape_Triangles, AreAllThatReachIntoTheBoxAndNoneFarAway) {
  struct Collect final : btTriangleCallback {
    std::multiset<int> found;
    void processTriangle(btVector3*, int, int index) override { found.insert(index); }
  };
  const Solid solid = ball(1, 6);
  const auto shape = treeShape(plainTree(solid, 4), btScalar(0.5));
  std::mt19937_64 engine(11);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3d p = randomPoint(engine) * 0.5;
    const btVector3 lower(p.x, p.y, p.z), upper = lower + btVector3(btScalar(0.2), btScalar(0.3), btScalar(0.1));
    Collect collect;
    shape->processAllTriangles(&collect, lower, upper);
    for (int i = 0; i < static_cast<int>(solid.triangles.size()); ++i) {
      btVector3 boxLower(9, 9, 9), boxUpper(-9, -9, -9);
      for (const std::uint32_t v : solid.triangles[static_cast<std::size_t>(i)]) {
        const Vec3d& c = solid.vertices[v];
        const btVector3 corner = shape->bodyFromMesh() * (btVector3(c.x, c.y, c.z) * shape->scale());
        boxLower.setMin(corner);
        boxUpper.setMax(corner);
      }
      const btScalar rounding = btScalar(1e-6);
      bool meets = true;
      for (int axis = 0; axis < 3; ++axis)
        meets = meets && boxLower[axis] <= upper[axis] + rounding && boxUpper[axis] >= lower[axis] - rounding;
      if (reachesInto(*shape, solid, i, lower, upper)) {
        EXPECT_EQ(collect.found.count(i), 1U) << "triangle " << i;
      }
      if (!meets) {
        EXPECT_EQ(collect.found.count(i), 0U) << "triangle " << i;
      }
    }
  }
}

TEST(SphereTreeShape_Triangles, AreAllInABoxWithoutEnd) {
  struct Count final : btTriangleCallback {
    std::size_t count = 0;
    void processTriangle(btVector3*, int, int) override { ++count; }
  };
  // The second is one ball about the origin.
  for (const auto& tree : {plainTree(cuboid({1, 2, 3}, 2)), plainTree(ball(1, 6), 600)}) {
    const auto shape = treeShape(tree, btScalar(0.5));
    for (const btScalar half : {btScalar(BT_LARGE_FLOAT), btScalar(1e30), std::numeric_limits<btScalar>::max(),
                                std::numeric_limits<btScalar>::infinity()}) {
      Count all, beyond;
      shape->processAllTriangles(&all, btVector3(-half, -half, -half), btVector3(half, half, half));
      EXPECT_EQ(all.count, tree->triangles().size()) << "half extent " << half;
      shape->processAllTriangles(&beyond, btVector3(9, -half, -half), btVector3(half, half, half));
      EXPECT_EQ(beyond.count, 0U) << "half extent " << half;
    }
  }
}

TEST(SphereTreeShape_Errors, NameWhatIsWrong) {
  const auto tree = plainTree(cuboid({1, 1, 1}, 1));
  const auto none = SphereTreeShape::create(nullptr);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("without a tree"), std::string::npos);
  for (const btScalar bad : {btScalar(0), btScalar(-1), std::numeric_limits<btScalar>::quiet_NaN(),
                             std::numeric_limits<btScalar>::infinity()})
    EXPECT_FALSE(SphereTreeShape::create(tree, BodyFrame::mesh, bad).ok()) << bad;

  const auto shape = treeShape(tree, 2);
  const Status uneven = shape->setScale(btVector3(1, 2, 1));
  ASSERT_FALSE(uneven.ok());
  EXPECT_NE(uneven.error().message.find("uniform"), std::string::npos);
  EXPECT_EQ(shape->scale(), 2) << "a refusal leaves the shape as it was";
  ASSERT_TRUE(shape->setScale(btVector3(3, 3, 3)).ok());
  EXPECT_EQ(shape->getLocalScaling().y(), 3);
}

// An engine takes its matrices apart and puts them together, and rounds.
TEST(SphereTreeShape_Scale, ThatDiffersByRoundingIsUniform) {
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 1)));
  const btScalar one = btScalar(0.99999994);
  for (const btVector3& scaling : {btVector3(1, one, 1), btVector3(one, 1, one), btVector3(1, 1, btScalar(1.000002))}) {
    ASSERT_TRUE(shape->setScale(scaling).ok());
    EXPECT_NEAR(double(shape->scale()), 1, double(bullet::kScaleRounding));
    EXPECT_EQ(shape->getLocalScaling().x(), shape->getLocalScaling().z());
  }
  const Status uneven = shape->setScale(btVector3(1, btScalar(0.75), 1));
  ASSERT_FALSE(uneven.ok());
  EXPECT_NE(uneven.error().message.find("(1, 0.75, 1)"), std::string::npos) << uneven.error().message;
  const Status tiny = shape->setScale(btVector3(btScalar(1e-30), btScalar(2e-30), btScalar(1e-30)));
  EXPECT_NE(tiny.error().message.find("e-30"), std::string::npos) << "what was compared: " << tiny.error().message;
}

// As every shape of Bullet: a scale takes the place of the one before, that of `create` too.
TEST(SphereTreeShape_Scale, IsThatOfTheMesh) {
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 1)), btScalar(0.5));
  EXPECT_EQ(shape->getLocalScaling().x(), btScalar(0.5));
  const btScalar half = shape->size();
  shape->setLocalScaling(btVector3(1, 1, 1));
  EXPECT_EQ(shape->size(), 2 * half);
}

TEST(SphereTreeShape_Tag, ForeignShapeOfTheSameTypeIsNotOurs) {
  struct Foreign final : btTriangleMeshShape {
    explicit Foreign(btStridingMeshInterface* mesh) : btTriangleMeshShape(mesh) {
      m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
    }
  };
  btTriangleMesh mesh;
  mesh.addTriangle(btVector3(-1, -1, 0), btVector3(1, -1, 0), btVector3(0, 1, 0));
  Foreign foreign(&mesh);
  EXPECT_EQ(bullet::asSphereTree(&foreign), nullptr);
  const auto ours = treeShape(plainTree(cuboid({1, 1, 1}, 1)));
  EXPECT_EQ(bullet::asSphereTree(ours.get()), ours.get());
}

TEST(SphereTreeShape_Create, RefusesAMeshWithoutSize) {
  const auto scaledBy = [](float factor) {
    SphereTreeData data = plainTree(cuboid({1, 1, 1}, 2))->data();
    for (Vec3& v : data.vertices) v = v * factor;
    return std::make_shared<const SphereTree>(SphereTree::create(data).value());
  };
  for (const float factor : {0.0F, 1e-25F}) {
    const auto shape = SphereTreeShape::create(scaledBy(factor));
    ASSERT_FALSE(shape.ok()) << factor;
    EXPECT_NE(shape.error().message.find("diagonal"), std::string::npos);
  }
  EXPECT_FALSE(SphereTreeShape::create(plainTree(cuboid({1, 1, 1}, 2)), BodyFrame::mesh, btScalar(3e38)).ok());
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 2)));
  EXPECT_FALSE(shape->setScale(btVector3(btScalar(3e38), btScalar(3e38), btScalar(3e38))).ok());
  EXPECT_EQ(shape->scale(), 1);
  for (const btScalar scale : {btScalar(1e-23), btScalar(1e20), btScalar(1e30)}) {
    EXPECT_FALSE(shape->setScale(btVector3(scale, scale, scale)).ok()) << scale;
    EXPECT_EQ(shape->scale(), 1);
  }
}

}  // namespace
}  // namespace cairn::test::shape_test
