// SPDX-License-Identifier: Zlib
// Contacts of a surface with a convex body, beside distances found by halving in double precision: Bullet's GJK is off
// by a thousandth of the size on round shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "bullet_world.h"
#include "colliders/closed_forms.h"
#include "colliders/convex_surface.h"
#include "extruded.h"

namespace cairn::test::convex_contacts_test {
namespace {

using namespace cairn::bullet;

constexpr std::uint32_t kSeed = 4711;

using Distance = std::function<double(const Vec3d&)>;  // of a point from a shape, in the shape's frame

double ofSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const double at = std::clamp(dot(p - a, b - a) / lengthSq(b - a), 0.0, 1.0);
  return length(p - a - (b - a) * at);
}

// The profile of a round shape, from its axis out and up, counterclockwise.
Distance turned(std::vector<std::array<double, 2>> profile, double margin) {
  return [profile = std::move(profile), margin](const Vec3d& p) {
    const Vec3d flat(std::hypot(p.x, p.z), p.y, 0);
    double border = 1e9, inside = -1e9;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const Vec3d a(profile[i][0], profile[i][1], 0), b(profile[i + 1][0], profile[i + 1][1], 0);
      border = std::min(border, ofSegment(flat, a, b));
      inside = std::max(inside, dot(flat - a, normalized(Vec3d(b.y - a.y, a.x - b.x, 0))));
    }
    return (inside < 0 ? inside : border) - margin;
  };
}

// Every three corners that have all others on one side are a face.
Distance ofHull(const btConvexHullShape& hull) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < hull.getNumVertices(); ++i) {
    btVector3 v;
    hull.getVertex(i, v);
    corners.emplace_back(double(v.x()), double(v.y()), double(v.z()));
  }
  std::vector<std::array<Vec3d, 3>> faces;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      for (std::size_t k = j + 1; k < corners.size(); ++k)
        for (const auto& face :
             {std::array{corners[i], corners[j], corners[k]}, std::array{corners[i], corners[k], corners[j]}}) {
          const Vec3d normal = cross(face[1] - face[0], face[2] - face[0]);
          if (std::ranges::all_of(corners, [&](const Vec3d& c) { return dot(normal, c - face[0]) <= 1e-12; }))
            faces.push_back(face);
        }
  return [faces, margin = double(hull.getMargin())](const Vec3d& p) {
    double border = 1e9, inside = -1e9;
    for (const auto& f : faces) {
      const Vec3d normal = normalized(cross(f[1] - f[0], f[2] - f[0]));
      const double height = dot(normal, p - f[0]);
      inside = std::max(inside, height);
      bool isOver = true;
      for (std::size_t k = 0; k < 3; ++k) {
        border = std::min(border, ofSegment(p, f[k], f[(k + 1) % 3]));
        isOver = isOver && dot(cross(normal, f[(k + 1) % 3] - f[k]), p - f[k]) >= 0;
      }
      if (isOver) border = std::min(border, std::abs(height));
    }
    return (inside < 0 ? inside : border) - margin;
  };
}

// Of a convex function between 0 and 1, by golden section.
template <class Function>
double leastOf(int steps, const Function& f) {
  constexpr double kPart = 0.6180339887498949;
  double from = 0, to = 1, low = 1 - kPart, high = kPart, atLow = f(low), atHigh = f(high);
  for (int i = 0; i < steps; ++i) {
    if (atLow < atHigh) {
      to = std::exchange(high, low);
      atHigh = atLow;
      low = to - kPart * (to - from);
      atLow = f(low);
    } else {
      from = std::exchange(low, high);
      atLow = atHigh;
      high = from + kPart * (to - from);
      atHigh = f(high);
    }
  }
  return std::min({atLow, atHigh, f(0), f(1)});
}

std::shared_ptr<btConvexHullShape> rock(std::mt19937& random, btScalar margin) {
  std::normal_distribution<double> normal;
  auto hull = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < 24; ++i) {
    btVector3 p(btScalar(normal(random)), btScalar(normal(random)), btScalar(normal(random)));
    hull->addPoint(p.normalized() * btVector3(btScalar(0.5), btScalar(0.35), btScalar(0.25)), false);
  }
  hull->recalcLocalAabb();
  hull->setMargin(margin);
  return hull;
}

// The rounding of a float a metre from the origin, through two changes of frame.
constexpr double kRounding = 2e-5;
// Hulls are found on a grid of ten thousand steps.
constexpr double kHullStep = 1e-4;

struct Asked {
  std::shared_ptr<btConvexShape> shape;
  Distance distance;
  double tolerance = kRounding;
};

std::vector<Asked> shapes() {
  std::mt19937 random(kSeed);
  const auto cylinder = std::make_shared<btCylinderShape>(btVector3(btScalar(0.3), btScalar(0.4), btScalar(0.3)));
  const auto cone = std::make_shared<btConeShape>(btScalar(0.3), btScalar(0.7));
  const auto rounded = rock(random, btScalar(0.04)), sharp = rock(random, 0);
  const double margin = double(cylinder->getMargin()), r = 0.3 - margin, h = 0.4 - margin;
  const auto box = [](const Vec3d& p) {
    const Vec3d out(std::abs(p.x) - 0.5, std::abs(p.y) - 0.3, std::abs(p.z) - 0.2);
    const Vec3d clamped(std::max(out.x, 0.0), std::max(out.y, 0.0), std::max(out.z, 0.0));
    return length(clamped) + std::min(std::max({out.x, out.y, out.z}), 0.0);
  };
  return {{std::make_shared<btSphereShape>(btScalar(0.4)), [](const Vec3d& p) { return length(p) - 0.4; }},
          {std::make_shared<btBoxShape>(btVector3(btScalar(0.5), btScalar(0.3), btScalar(0.2))), box},
          {std::make_shared<btCapsuleShapeX>(btScalar(0.2), btScalar(0.5)),
           [](const Vec3d& p) {
             return ofSegment(p, {-0.25, 0, 0}, {0.25, 0, 0}) - 0.2;
           }},
          {cylinder, turned({{0, -h}, {r, -h}, {r, h}, {0, h}}, margin)},
          {cone, turned({{0, -0.35}, {0.3, -0.35}, {0, 0.35}}, double(cone->getMargin()))},
          {rounded, ofHull(*rounded), kRounding + kHullStep},
          {sharp, ofHull(*sharp), kRounding + kHullStep}};
}

btVector3 randomVector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {btScalar(normal(random)), btScalar(normal(random)), btScalar(normal(random))};
}

btQuaternion randomTurn(std::mt19937& random) {
  std::normal_distribution<double> normal;
  btQuaternion turn(btScalar(normal(random)), btScalar(normal(random)), btScalar(normal(random)),
                    btScalar(normal(random)));
  return turn.normalized();
}

Vec3 toFloats(const btVector3& v) {
  return {float(v.x()), float(v.y()), float(v.z())};
}

TEST(ConvexSurface, IsAsFarAsItIs) {
  for (const auto& [shape, distance, tolerance] : shapes()) {
    std::mt19937 random(kSeed);
    ConvexSurface surface;
    surface.setShape(*shape);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = toFloats(randomVector(random) * btScalar(0.6));
      const NearestPoint nearest = surface.nearest(p);
      ASSERT_NEAR(nearest.distance, distance(Vec3d(p)), tolerance) << shape->getName() << " " << i;
      // The plane through the point supports the shape.
      ASSERT_NEAR(dot(nearest.normal, surface.support(nearest.normal) - nearest.point), 0, tolerance)
          << shape->getName() << " " << i;
    }
  }
}

// A capsule without height is a ball.
TEST(ConvexSurface, HasANumberForWhatIsAPoint) {
  btCapsuleShape point(btScalar(0.3), 0);
  ConvexSurface surface;
  surface.setShape(point);
  EXPECT_NEAR(surface.nearest({0, 1, 0}).distance, 0.7, kRounding);
  EXPECT_NEAR(surface.nearest({0, 0, 0}).distance, -0.3, kRounding);
  EXPECT_NEAR(length(surface.nearest({0, 0, 0}).normal), 1, kRounding);
}

TEST(ConvexSurface, AsksHugeHullsByGjk) {
  std::mt19937 random(kSeed);
  for (const int corners : {100, 2000}) {
    btConvexHullShape hull;
    for (int i = 0; i < corners; ++i) hull.addPoint(randomVector(random).normalized(), false);
    hull.recalcLocalAabb();
    hull.setMargin(btScalar(0.04));
    EXPECT_EQ(HullFaces::of(hull) != nullptr, corners < 2000);
    ConvexSurface surface;
    surface.setShape(hull);
    EXPECT_NEAR(surface.nearest({3, 0, 0}).distance, 3 - surface.support({1, 0, 0}).x, 0.02) << corners;
  }
}

// A user may scale a hull, or give it another corner, between two steps.
TEST(ConvexSurface, NoticesThatAHullHasChanged) {
  std::mt19937 random(kSeed);
  const auto hull = rock(random, btScalar(0.01));
  ConvexSurface surface;
  surface.setShape(*hull);
  const float before = surface.nearest({3, 0, 0}).distance;
  hull->setLocalScaling(btVector3(2, 2, 2));
  surface.setShape(*hull);
  const float scaled = surface.nearest({3, 0, 0}).distance;
  EXPECT_LT(scaled, before - 0.2F);
  hull->addPoint(btVector3(1, 0, 0));
  surface.setShape(*hull);
  EXPECT_NEAR(surface.nearest({3, 0, 0}).distance, 3 - 2 - 0.01, kRounding);
}

std::vector<Solid> solids() {
  const Outline key{{-0.1, -0.3}, {0.1, -0.3}, {0.1, -0.1}, {0.25, -0.1},
                    {0.25, 0.05}, {0.1, 0.05}, {0.1, 0.3},  {-0.1, 0.3}};
  return {cuboid({1, 0.6, 0.4}, 3), ball(0.5, 6), torus(0.4, 0.15, 16), extruded(key, -0.4, 0.4),
          holedBlock(0.5, 0.25, 12, -0.3, 0.3)};
}

// The least of all triangles' distances: where they overlap, about minus the depth.
double distanceOf(const Solid& solid, const Distance& distance, const btTransform& place, int steps = 32) {
  const btTransform toShape = place.inverse();
  std::vector<Vec3d> corners;
  std::vector<double> far;
  for (const Vec3d& v : solid.vertices) {
    const btVector3 p = toShape * btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z));
    corners.emplace_back(double(p.x()), double(p.y()), double(p.z()));
    far.push_back(distance(corners.back()));
  }
  // No point of a triangle is farther from its nearest corner than its longest side.
  std::vector<std::pair<double, std::array<Vec3d, 3>>> triangles;
  for (const auto& [i, j, k] : solid.triangles) {
    const Vec3d &a = corners[i], &b = corners[j], &c = corners[k];
    const double longest = std::max({length(b - a), length(c - a), length(c - b)});
    triangles.push_back({std::min({far[i], far[j], far[k]}) - longest, {a, b, c}});
  }
  std::ranges::sort(triangles, {}, &std::pair<double, std::array<Vec3d, 3>>::first);
  double least = 1e9;
  for (const auto& [bound, triangle] : triangles) {
    if (bound > least) break;
    const Vec3d &a = triangle[0], &b = triangle[1], &c = triangle[2];
    least = std::min(least, leastOf(steps, [&](double s) {
                       const Vec3d from = a + (b - a) * s, to = a + (c - a) * s;
                       return leastOf(steps, [&](double t) { return distance(from + (to - from) * t); });
                     }));
  }
  return least;
}

// The nearest pair of points is a local minimum. It is reported with its distance if it is within reach, and nothing
// nearer.
TEST(ConvexContacts, TellWhatIsNearest) {
  int told = 0;
  for (const Solid& solid : solids()) {
    const auto tree = treeShape(plainTree(solid, 4));
    for (const auto& [shape, distance, tolerance] : shapes()) {
      std::mt19937 random(kSeed);
      BulletWorld<> w;
      w.add(tree, 0, btVector3(0, 0, 0));
      btRigidBody& body = w.add(shape, 1, btVector3(0, 0, 0));
      for (int i = 0; i < 4; ++i) {
        const btQuaternion turn = randomTurn(random);
        const btVector3 way = randomVector(random).normalized();
        // Along the way, to where it is half a contact distance off, about.
        double from = 0, to = 3;
        const double reach = double(kSpeculativeFraction) * 0.25;
        for (int k = 0; k < 13; ++k) {
          const double at = 0.5 * (from + to);
          (distanceOf(solid, distance, btTransform(turn, way * btScalar(at)), 14) > reach ? to : from) = at;
        }
        const btTransform place(turn, way * btScalar(to));
        body.setWorldTransform(place);
        w.world.performDiscreteCollisionDetection();
        double nearest = 1e9;
        for (int m = 0; m < w.dispatcher.getNumManifolds(); ++m) {
          const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(m);
          for (int c = 0; c < manifold.getNumContacts(); ++c)
            nearest = std::min(nearest, double(manifold.getContactPoint(c).getDistance()));
        }
        EXPECT_NEAR(nearest, distanceOf(solid, distance, place), tolerance)
            << shape->getName() << " " << i << ", solid of " << solid.triangles.size() << ", seed " << kSeed;
        told += nearest < 1e9 ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(told, 5 * 7 * 4);
}

}  // namespace
}  // namespace cairn::test::convex_contacts_test
