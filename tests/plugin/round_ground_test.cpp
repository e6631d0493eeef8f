// SPDX-License-Identifier: Zlib
// A body on round ground touches it with points of large leaves, which may be anywhere in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "distance_fields.h"
#include "placement/bullet_math.h"
#include "placement/triangle.h"
#include "still_scenes.h"

namespace cairn::test::round_ground_test {
namespace {

using namespace cairn::bullet;

constexpr unsigned kSeed = 7;
constexpr std::uint32_t kTrianglesOfAnEighth = 100;
constexpr double kAbove = 0.01;  // metres, where bodies are let go
/// Of the size, what a dozen descents leave of the way to the lowest point inside a face: measured 0.0034.
constexpr double kDescended = 0.005;

/// Every leaf's ball is all but the whole ball, as a good builder's are.
std::shared_ptr<const SphereTree> ballOfWholeBalls(double radius) {
  const Solid solid = ball(radius, 10);
  double inner = radius;
  for (const auto& t : solid.triangles) {
    const Vec3d a = solid.vertices[t[0]], normal = cross(solid.vertices[t[1]] - a, solid.vertices[t[2]] - a);
    inner = std::min(inner, dot(a, normal) / length(normal));
  }
  SphereTreeData data = PlainTreeBuilder(solid, kTrianglesOfAnEighth).build();
  for (NodeData& node : data.nodes) {
    node.center = {};
    node.radius = float(radius) * (1 + 1e-5F);
    node.error = node.radius - float(inner) + 1e-5F;
  }
  return std::make_shared<const SphereTree>(std::move(SphereTree::create(std::move(data))).value());
}

/// How far the body's mesh is from a ball about the origin.
double gapOf(const btRigidBody& body, double radius) {
  const auto& shape = static_cast<const SphereTreeShape&>(*body.getCollisionShape());
  const btTransform treeFromWorld = (body.getWorldTransform() * shape.bodyFromTree()).inverse();
  const Vec3 origin = toVec3(treeFromWorld.getOrigin());
  const auto vertices = shape.tree().vertices();
  double least = std::numeric_limits<double>::max();
  for (const auto& t : shape.tree().triangles()) {
    const Triangle triangle{vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    least = std::min(least, double(distance(nearestOnTriangle(triangle, origin).point, origin)));
  }
  return least - radius;
}

/// Turned somehow and let down onto a ball about the origin, along the vertical alone.
double gapAtRest(const std::shared_ptr<btCollisionShape>& ground, double radius,
                 const std::shared_ptr<const SphereTree>& tree, std::mt19937_64& engine) {
  std::normal_distribution<btScalar> normal;
  BulletWorld<> w;
  w.add(ground, 0, btVector3(0, 0, 0));
  btRigidBody& body = w.add(treeShape(tree), 1, btVector3(0, 0, 0));
  const btScalar x = normal(engine), y = normal(engine), z = normal(engine), angle = normal(engine);
  btTransform at(btQuaternion(x, y, z, angle).normalized());
  at.setOrigin(btVector3(0, 0, btScalar(radius + 3)));
  body.setWorldTransform(at);
  for (int i = 0; i < 20; ++i) {  // a distance down the vertical never goes too far
    at.getOrigin() -= btVector3(0, 0, btScalar(gapOf(body, radius) - kAbove));
    body.setWorldTransform(at);
  }
  body.setLinearFactor(btVector3(0, 0, 1));
  body.setAngularFactor(btVector3(0, 0, 0));
  w.step(200);
  return gapOf(body, radius);
}

struct Ground {
  const char* name;
  double radius;
  std::shared_ptr<btCollisionShape> shape;
  double off;  // of its surface, from the ball it is of
};

std::vector<Ground> grounds() {
  std::vector<Ground> all;
  for (const double radius : {0.5, 1.0, 5.0}) {
    all.push_back({"sphere", radius, std::make_shared<btSphereShape>(btScalar(radius)), 0});
    const double half = 1.3 * radius;
    const double cell = 2 * half / 32;
    all.push_back({"field", radius,
                   fieldShape({{-half, -half, -half}, {half, half, half}, {32, 32, 32}}, ballDistance(radius)),
                   cell * cell / (4 * radius)});  // twice what a parabola leaves a cell's chord
  }
  return all;
}

void expectRest(const char* name, const std::shared_ptr<const SphereTree>& tree, double tolerance) {
  std::mt19937_64 engine(kSeed);
  tolerance *= double(treeShape(tree)->size());
  for (const Ground& ground : grounds())
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(gapAtRest(ground.shape, ground.radius, tree, engine), 0, tolerance + ground.off)
          << name << " on a " << ground.name << " of radius " << ground.radius << ", seed " << kSeed << ", turn " << i;
}

TEST(RoundGround, LeavesThatAreNearlyTheWholeBodyNeitherFloatNorSinkIn) {
  expectRest("ball of whole balls", ballOfWholeBalls(1), kSpeculativeFraction);
}

TEST(RoundGround, LeavesWithMoreCornersThanSupportPointsNeitherFloatNorSinkIn) {
  expectRest("ball", plainTree(ball(1, 10), kTrianglesOfAnEighth), kSpeculativeFraction);
  expectRest("cylinder", plainTree(revolved({{0, -1}, {1, -1}, {1, 1}, {0, 1}}, 64), 32), kDescended);
}

}  // namespace
}  // namespace cairn::test::round_ground_test
