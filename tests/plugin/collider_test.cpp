// SPDX-License-Identifier: Zlib
// The geometry of the colliders against brute force.
#include <gtest/gtest.h>

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

#include "colliders/closed_forms.h"
#include "colliders/convex_collider.h"
#include "colliders/convex_surface.h"
#include "colliders/plane_collider.h"
#include "random_tree.h"
#include "triangles/triangle_soup.h"

namespace cairn::test::collider_test {
namespace {

using namespace cairn::bullet;

// Bullet's GJK stops at a relative error of 1e-6 in squared distance, 1e-3 in distance; distances here reach 4.
constexpr float kGjkTolerance = 4e-3F;
// EPA stops at 128 vertices of its polytope: on a round shape of radius r a facet then stands off by about 4 pi r / 128
// / 4.
constexpr float kEpaTolerance = 0.05F;

TEST(ConvexSurface_Box, ClosedFormAgreesWithGjk) {
  btBoxShape box(btVector3(btScalar(0.5), btScalar(0.7), btScalar(0.9)));
  btConvexHullShape hull;
  for (int c = 0; c < 8; ++c)
    hull.addPoint(btVector3(btScalar(c & 1 ? 0.5 : -0.5), btScalar(c & 2 ? 0.7 : -0.7), btScalar(c & 4 ? 0.9 : -0.9)));
  hull.setMargin(0);
  ConvexSurface closedForm, gjk;
  closedForm.setShape(box);
  gjk.setShape(hull);
  std::mt19937_64 engine(3);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 p(randomPoint(engine) * 1.5);
    const NearestPoint expected = closedForm.nearest(p), actual = gjk.nearest(p);
    ASSERT_NEAR(actual.distance, expected.distance, kGjkTolerance) << "seed 3, trial " << trial;
    if (expected.distance > 0.01F) {
      ASSERT_LT(distance(actual.point, expected.point), kGjkTolerance) << "seed 3, trial " << trial;
    }
  }
}

TEST(ConvexSurface_Sphere, ClosedFormIsTheDefinition) {
  std::mt19937_64 engine(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 p(randomPoint(engine) * 2.0);
    const NearestPoint n = nearestOnSphere(0.7F, p);
    EXPECT_NEAR(n.distance, length(p) - 0.7F, 1e-6F);
    EXPECT_NEAR(length(n.point), 0.7F, 1e-6F);
    EXPECT_NEAR(dot(n.normal, p), length(p), 1e-5F);
  }
}

// Squares of what is below 1e-19 have few digits left, or none.
TEST(ConvexSurface_AnyShape, HasAUnitNormalHoweverNearTheMiddle) {
  const btSphereShape sphere(btScalar(0.7));
  const btBoxShape box(btVector3(btScalar(0.5), btScalar(0.7), btScalar(0.9)));
  const btCylinderShape cylinder(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.9)));
  const btConvexShape* const shapes[] = {&sphere, &box, &cylinder};
  std::mt19937_64 engine(5);
  for (const btConvexShape* shape : shapes) {
    ConvexSurface surface;
    surface.setShape(*shape);
    for (int power = 0; power <= 45; ++power)
      for (int trial = 0; trial < 10; ++trial) {
        const Vec3 p(randomPoint(engine) * std::pow(10.0, -power));
        EXPECT_NEAR(length(surface.nearest(p).normal), 1, 1e-5) << shape->getName() << ", 1e-" << power;
      }
  }
}

TEST(ConvexSurface_AnyShape, HasAUnitNormalHoweverSmallItIs) {
  std::mt19937_64 engine(7);
  for (int power = 0; power <= 40; ++power) {
    const btScalar size = btScalar(std::pow(10.0, -power));
    btCylinderShape cylinder(btVector3(size, size, size));
    btConeShape cone(size, 2 * size);
    btCapsuleShape capsule(size, size);
    cylinder.setMargin(size / 10);
    cone.setMargin(size / 10);
    for (const btConvexShape* shape :
         {static_cast<const btConvexShape*>(&cylinder), static_cast<const btConvexShape*>(&cone),
          static_cast<const btConvexShape*>(&capsule)})
      for (int trial = 0; trial < 40; ++trial) {
        // Near it and far from it, as its own size and the world's are.
        const Vec3 p(randomPoint(engine) * (trial % 2 ? 3 * double(size) : 1.0));
        const std::optional<NearestPoint> nearest = nearestOnRound(*shape, p);
        ASSERT_TRUE(nearest.has_value());
        EXPECT_NEAR(length(Vec3d(nearest->normal)), 1, 1e-5) << shape->getName() << ", 1e-" << power;
      }
  }
}

// Whatever the shape, all of it lies behind the plane through the nearest point: that is what makes a contact's depth
// valid.
TEST(ConvexSurface_AnyShape, LiesBehindThePlaneOfItsNearestPoint) {
  btCylinderShape cylinder(btVector3(btScalar(0.4), btScalar(0.8), btScalar(0.4)));
  btConeShape cone(btScalar(0.5), 1);
  btCapsuleShape capsule(btScalar(0.3), 1);
  btVector3 centers[] = {btVector3(0, 0, 0), btVector3(1, 0, 0)};
  btScalar radii[] = {btScalar(0.3), btScalar(0.5)};
  btMultiSphereShape spheres(centers, radii, 2);
  std::mt19937_64 engine(6);
  for (const btConvexShape* shape :
       {static_cast<const btConvexShape*>(&cylinder), static_cast<const btConvexShape*>(&cone),
        static_cast<const btConvexShape*>(&capsule), static_cast<const btConvexShape*>(&spheres)}) {
    ConvexSurface surface;
    surface.setShape(*shape);
    for (int trial = 0; trial < 300; ++trial) {
      const Vec3 p(randomPoint(engine) * 1.5);
      const NearestPoint n = surface.nearest(p);
      const btVector3 top = shape->localGetSupportingVertex(btVector3(n.normal.x, n.normal.y, n.normal.z));
      const float over = dot(n.normal, Vec3(float(top.x()), float(top.y()), float(top.z())) - n.point);
      ASSERT_LT(over, n.distance > 0 ? kGjkTolerance : kEpaTolerance)
          << shape->getName() << ", seed 6, trial " << trial;
      ASSERT_NEAR(length(n.normal), 1, 1e-4F);
    }
  }
}

TEST(Triangle_Nearest, IsTheNearestOfAFineGrid) {
  std::mt19937_64 engine(8);
  for (int trial = 0; trial < 300; ++trial) {
    const Triangle t{Vec3(randomPoint(engine)), Vec3(randomPoint(engine)), Vec3(randomPoint(engine))};
    const Vec3 p(randomPoint(engine) * 2.0);
    constexpr int kGrid = 60;
    float best = 1e9F;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; i + j <= kGrid; ++j) {
        const float u = float(i) / kGrid, v = float(j) / kGrid;
        best = std::min(best, distance(p, t.a + (t.b - t.a) * u + (t.c - t.a) * v));
      }
    const float actual = distance(p, nearestOnTriangle(t, p).point);
    EXPECT_LE(actual, best + 1e-5F) << "seed 8, trial " << trial;
    EXPECT_GE(actual, best - 4.0F / kGrid) << "not on the triangle; seed 8, trial " << trial;
  }
}

TEST(Triangle_Nearest, CopesWithDegenerateTriangles) {
  const Triangle line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_LT(distance(nearestOnTriangle(line, {1.5F, 1, 0}).point, Vec3(1.5F, 0, 0)), 1e-6F);
  EXPECT_FALSE(nearestOnTriangle(line, {1.5F, 1, 0}).onFace);
  const Triangle point{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(nearestOnTriangle(point, {5, 0, 0}).point, Vec3(1, 1, 1));
  EXPECT_EQ(point.normal(), Vec3(0, 0, 0));
}

Family randomFamily(std::mt19937_64& engine, std::uint32_t size) {
  Family f;
  for (std::uint32_t i = 0; i < size; ++i)
    f.set(i, {Vec3(randomPoint(engine) * 2.0), float(uniform(engine, 0.05, 0.5))});
  return f;
}

// An obstacle may report too much, never too little; where it claims to be exact, neither.
TEST(Obstacles_Touches, AgreeWithOneSphereAtATime) {
  std::mt19937_64 engine(9);
  const Vec3 half(0.4F, 0.8F, 0.6F);
  PlaneObstacle plane;
  ConvexObstacle box;
  SoupObstacle soup;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto size = static_cast<std::uint32_t>(1 + engine() % kFamilyWidth);
    const Family family = randomFamily(engine, size);
    const Vec3 normal(normalized(randomPoint(engine)));
    const auto offset = float(uniform(engine, -1, 1));
    plane.place(normal, offset, 0);
    const Pose pose{randomRotation(engine), randomPoint(engine), uniform(engine, 0.5, 2)};
    box.place(relativePose(Pose{}, pose), {}, half, 0);
    const Triangle t{Vec3(randomPoint(engine)), Vec3(randomPoint(engine)), Vec3(randomPoint(engine))};
    soup.clear(0);
    soup.add(t);
    for (std::uint32_t i = 0; i < kFamilyWidth; ++i) {
      const bool isAlive = i < size;
      const Sphere s = isAlive ? family.sphere(i) : Sphere{};
      const float abovePlane = dot(normal, s.center) - offset - s.radius;
      const Vec3 inBox(pose * Vec3d(s.center));
      const float outsideBox = nearestOnBox(half, inBox).distance - s.radius * float(pose.scale);
      const float offTriangle = distance(s.center, nearestOnTriangle(t, s.center).point) - s.radius;
      const auto expect = [&](const Obstacle& obstacle, float separation, const char* what) {
        const bool hit = (obstacle.touches(family, size, 0) >> i & 1U) != 0;
        if (!isAlive) {
          EXPECT_FALSE(hit) << what << ": dead lane";
        } else if (std::abs(separation) > 1e-5F) {
          EXPECT_EQ(hit, separation < 0) << what << ", seed 9, trial " << trial;
        }
      };
      expect(plane, abovePlane, "plane");
      expect(box, outsideBox, "box");
      expect(soup, offTriangle, "triangle");
    }
  }
}

// A user's shape need not number its triangles.
TEST(TriangleSoup_Find, TellsTrianglesWithoutNumbersApart) {
  struct Unnumbered final : btConcaveShape {
    int turn = 0;
    void processAllTriangles(btTriangleCallback* callback, const btVector3&, const btVector3&) const override {
      for (int i = 0; i < 5; ++i) {
        const auto x = btScalar((i + turn) % 5);
        btVector3 triangle[] = {btVector3(x, 0, 0), btVector3(x + 1, 0, 0), btVector3(x, 1, 0)};
        callback->processTriangle(triangle, -1, -1);
      }
    }
    void getAabb(const btTransform&, btVector3&, btVector3&) const override {}
    void setLocalScaling(const btVector3&) override {}
    const btVector3& getLocalScaling() const override { return one; }
    void calculateLocalInertia(btScalar, btVector3&) const override {}
    const char* getName() const override { return "Unnumbered"; }
    btVector3 one{1, 1, 1};
  } shape;
  const btVector3 lower(-9, -9, -9), upper(9, 9, 9);
  TriangleSoup soup;
  soup.gather(shape, lower, upper);
  const std::vector<TriangleSoup::Source> first = soup.triangles();
  shape.turn = 2;
  soup.gather(shape, lower, upper);
  for (const TriangleSoup::Source& wanted : first) {
    const int found = soup.find(wanted);
    ASSERT_GE(found, 0);
    EXPECT_EQ(soup.triangles()[static_cast<std::size_t>(found)].corners[0].x(), wanted.corners[0].x());
  }
}

}  // namespace
}  // namespace cairn::test::collider_test
