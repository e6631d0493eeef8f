// SPDX-License-Identifier: Zlib
// Meshes and trees set down on each other, flush, over an edge, astride or between: they come out upwards, and what
// nothing holds falls.
#include <gtest/gtest.h>

#include "deepest_contact.h"
#include "gimpact_mesh.h"
#include "still_scenes.h"
#include "triangle_grounds.h"

namespace cairn::test::mesh_set_down_test {
namespace {

constexpr btScalar kMargin = btScalar(0.001);

// A crate set down on a crate of the same section: their sides lie in the same planes, or nearly.
class SetDownFlush : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  // Of the upper one, a tree or a mesh, metres.
  struct End {
    double told, aside, height;
  };
  static End setDown(std::shared_ptr<btCollisionShape> lower, std::shared_ptr<btCollisionShape> upper,
                     const btVector3& at) {
    StillWorld w;
    btRigidBody& ground = w.add(std::move(lower), 0, btVector3(0, 0, 0));
    btRigidBody& body = w.add(std::move(upper), 1, at);
    body.setActivationState(DISABLE_DEACTIVATION);
    DeepestContact deepest;
    w.world.contactPairTest(&ground, &body, deepest);
    w.step(180);
    const btVector3 way = body.getWorldTransform().getOrigin() - at;
    return {double(deepest.separation), std::hypot(double(way.x()), double(way.y())),
            double(body.getWorldTransform().getOrigin().z())};
  }
};

TEST_P(SetDownFlush, ComesOutUpwards) {
  constexpr double kAsideOfABox = 0.03;  // metres: what Bullet's box moves on its mesh
  constexpr double kRestTolerance = 0.005;
  constexpr double kTilt = 0.2;  // of the depth: at edges of both normals are between their faces'
  const auto& [cells, others] = GetParam();
  const auto tree = treeShape(plainTree(cuboid({1, 1, 1}, cells)));
  const Solid other = cuboid({1, 1, 1}, others);
  const std::shared_ptr<btCollisionShape> gimpact = gimpactMesh(other, kMargin), still = bvhMesh(other);
  const struct {
    const char* name;
    std::shared_ptr<btCollisionShape> lower, upper;
  } all[] = {{"tree on mesh", still, tree}, {"tree on GImpact", gimpact, tree}, {"GImpact on tree", tree, gimpact}};
  for (const auto& pair : all)
    for (const double depth : {0.002, 0.005, 0.02, 0.05})
      for (const btVector3& aside :
           {btVector3(0, 0, 0), btVector3(0.001F, 0, 0), btVector3(0.001F, 0.001F, 0), btVector3(0.003F, 0, 0),
            btVector3(0.01F, 0.01F, 0), btVector3(0.05F, 0.02F, 0), btVector3(0.2F, 0.07F, 0), btVector3(0.4F, 0, 0)}) {
        const End end = setDown(pair.lower, pair.upper, aside + btVector3(0, 0, btScalar(1 - depth)));
        SCOPED_TRACE(testing::Message() << pair.name << ", " << depth << " deep, aside " << aside.x() << ", "
                                        << aside.y());
        EXPECT_NEAR(end.told, -depth, kTilt * depth + 2 * double(kMargin));
        EXPECT_LT(end.aside, kAsideOfABox + depth) << "aside by more than up";
        EXPECT_NEAR(end.height, 1, kRestTolerance);
      }
}

INSTANTIATE_TEST_SUITE_P(CellsOfBoth, SetDownFlush, testing::Combine(testing::Values(1, 3), testing::Values(1, 3)));

// A body set down across an edge is held up to the edge.
TEST(OverhangingMesh, StaysWhereItWasSetDown) {
  constexpr double kCrept = 0.02, kRestTolerance = 0.002;  // metres
  for (const double size : {0.9, 0.7, 0.4})
    for (const int cells : {1, 3})
      for (const double depth : {0.0, 0.005, 0.02, 0.05}) {
        StillWorld w;
        w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 0, btVector3(0, 0, 0));
        const btVector3 at(0.4F, 0, btScalar(0.5 + size / 2 - depth));
        btRigidBody& body = w.add(gimpactMesh(cuboid({size, size, size}, cells), kMargin), 1, at);
        body.setActivationState(DISABLE_DEACTIVATION);
        w.step(180);
        const btVector3 way = body.getWorldTransform().getOrigin() - at;
        SCOPED_TRACE(testing::Message() << size << " m, " << cells << " cells, " << depth << " deep");
        EXPECT_LT(std::hypot(double(way.x()), double(way.y())), kCrept);
        EXPECT_NEAR(double(way.z()), depth, kRestTolerance);
      }
}

// A board on two legs, soups being enough for GImpact: its board 0.1 m thick, its legs 0.3 m long and `clearance` from
// what they stand astride of, which is a metre wide.
Solid saddle(double clearance) {
  constexpr double kThick = 0.1, kLeg = 0.3;
  const double away = 0.5 + clearance + kThick / 2;
  Solid all;
  const auto add = [&](const Vec3d& size, const Vec3d& at) {
    const Solid part = cuboid(size, 2);
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (const Vec3d& v : part.vertices) all.vertices.push_back(v + at);
    for (const auto& t : part.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  add({2 * away + kThick, 0.4, kThick}, {0, 0, kThick / 2});
  for (const double side : {-away, away}) add({kThick, 0.4, kLeg}, {side, 0, -kLeg / 2});
  return all;
}

TEST(Saddle, LiesStillOnWhatItIsAstrideOf) {
  constexpr double kAside = 0.06, kRestTolerance = 0.003, kStill = 0.02;  // metres, metres a second
  for (const double clearance : {0.0, 0.002, 0.01, 0.05})
    for (const double depth : {-0.05, 0.0, 0.003, 0.02})
      for (const int cells : {1, 4}) {
        StillWorld w;
        w.add(treeShape(plainTree(cuboid({1, 1, 1}, cells))), 0, btVector3(0, 0, btScalar(-0.5)));
        const btVector3 at(0, 0, btScalar(-depth));
        btRigidBody& body = w.add(gimpactMesh(saddle(clearance), kMargin), 1, at);
        body.setActivationState(DISABLE_DEACTIVATION);
        w.step(240);
        const btVector3& p = body.getWorldTransform().getOrigin();
        SCOPED_TRACE(testing::Message() << clearance << " m off, " << depth << " deep, " << cells << " cells");
        EXPECT_LT(std::hypot(double(p.x()), double(p.y())), kAside);
        EXPECT_NEAR(double(p.z()), 0, kRestTolerance);
        EXPECT_LT(double(body.getLinearVelocity().length()), kStill);
      }
}

// Crates in a row: what holds nothing from below holds nothing, however level and flush.
TEST(CrateBetweenCrates, FallsFreely) {
  for (const double top : {0.0, -0.003, 0.2})
    for (const int cells : {1, 3}) {
      StillWorld w;
      const auto crate = treeShape(plainTree(cuboid({1, 1, 1}, 3)));
      for (const double side : {-1.0, 1.0}) w.add(crate, 0, btVector3(btScalar(side), 0, 0)).setFriction(0);
      btRigidBody& body = w.add(gimpactMesh(cuboid({1, 1, 1}, cells), 0), 1, btVector3(0, 0, btScalar(top)));
      body.setFriction(0);
      w.step(30);
      EXPECT_LT(double(body.getWorldTransform().getOrigin().z()), top - 1) << top << ", " << cells;
    }
}

}  // namespace
}  // namespace cairn::test::mesh_set_down_test
