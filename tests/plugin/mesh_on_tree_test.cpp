// SPDX-License-Identifier: Zlib
// Meshes of triangles that move over the flat leaves of a larger tree, whatever size these leaves are: they slide on
// them, come to rest on them, and go through none.
#include <gtest/gtest.h>

#include <random>

#include "collider_trials.h"
#include "deepest_contact.h"

namespace cairn::test::mesh_on_tree_test {
namespace {

constexpr btScalar kMargin = btScalar(0.001);

class MeshSlides : public testing::TestWithParam<int> {};

// Within what the solver's steps make of it.
TEST_P(MeshSlides, AsFarAsFrictionLetsIt) {
  constexpr double kTolerance = 0.02;
  const TreeOf treeOf = [](const Solid& solid) { return plainTree(solid); };
  const TriedGround slab{"tree", treeShape(plainTree(cuboid({16, 16, 1}, GetParam()))), btScalar(0.5)};
  TriedMover mesh = blockMover("GImpact", gimpactMesh(block(), kMargin), kMargin);
  mesh.meshMargin = kMargin;
  for (const bool bodyFirst : {false, true}) {
    const double theory = Trials::slideTheory(slab, mesh);
    EXPECT_NEAR(Trials::slide(slab, mesh, bodyFirst).acceleration, theory, kTolerance * theory) << bodyFirst;
  }
}

INSTANTIATE_TEST_SUITE_P(CellsOfASlab, MeshSlides, testing::Values(1, 2, 4, 8, 16, 32, 64));

struct Thrown {
  const char* name;
  Solid solid;
  bool rolls;
};

class ThrownMesh : public testing::TestWithParam<std::tuple<double, int>> {
 protected:
  static double lowest(const Solid& solid, const btTransform& at) {
    double low = std::numeric_limits<double>::infinity();
    for (const Vec3d& v : solid.vertices)
      low = std::min(low, double((at * btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z))).z()));
    return low;
  }
};

TEST_P(ThrownMesh, StaysOnTheSlab) {
  constexpr int kSeeds = 3;
  constexpr double kDeepest = 0.01;  // metres: what a blow of some m/s presses in, and a hundredth of the bodies
  constexpr btScalar kStill = btScalar(0.02);
  const auto& [thickness, cells] = GetParam();
  const auto slab = treeShape(plainTree(cuboid({8, 8, thickness}, cells)));
  const Thrown all[] = {{"block", block(), false},
                        {"block of 12 triangles", cuboid({1, 0.4, 0.3}, 1), false},
                        {"ball", ball(0.3, 8), true},
                        {"ring", torus(0.4, 0.12, 24), false}};
  for (const Thrown& thrown : all)
    for (int seed = 0; seed < kSeeds; ++seed) {
      std::mt19937 engine(static_cast<std::uint32_t>(seed));
      std::uniform_real_distribution<float> uniform(-1, 1);
      const auto number = [&] { return btScalar(uniform(engine)); };
      StillWorld w;
      w.add(slab, 0, btVector3(0, 0, btScalar(-thickness / 2))).setFriction(btScalar(0.7));
      const btQuaternion turned = btQuaternion(number(), number(), number(), number()).normalized();
      const btVector3 start(number(), number(), 1), velocity(number(), number(), -1);
      btRigidBody& body = w.add(gimpactMesh(thrown.solid, kMargin), 1, start, turned);
      body.setActivationState(DISABLE_DEACTIVATION);
      body.setLinearVelocity(velocity);
      w.step(300);
      EXPECT_GT(lowest(thrown.solid, body.getWorldTransform()), -kDeepest) << thrown.name << ", seed " << seed;
      if (!thrown.rolls) {
        EXPECT_LT(body.getLinearVelocity().length(), kStill) << thrown.name << ", seed " << seed;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Slabs, ThrownMesh, testing::Combine(testing::Values(1.0, 0.2), testing::Values(1, 4, 8, 32)));

// A floor and a wall meet in an edge that points inwards: both hold.
TEST(MeshInACorner, IsHeldByBothFaces) {
  for (const int cells : {1, 4, 16}) {
    StillWorld w;
    w.add(treeShape(plainTree(cuboid({8, 8, 1}, cells))), 0, btVector3(0, 0, btScalar(-0.5)));
    w.add(treeShape(plainTree(cuboid({1, 8, 8}, cells))), 0, btVector3(btScalar(1.5), 0, btScalar(3.9)));
    btRigidBody& body = w.add(gimpactMesh(block(), kMargin), 1, btVector3(btScalar(0.3), 0, btScalar(0.2)));
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setLinearVelocity(btVector3(2, 0, 0));
    w.step(60);
    EXPECT_LT(body.getWorldTransform().getOrigin().x(), 0.51) << cells;
    EXPECT_GT(body.getWorldTransform().getOrigin().z(), 0.14) << cells;
  }
}

// Set down half a centimetre deep: it comes out where it went in.
TEST(MeshSetDown, ComesOutOfTheFaceItIsIn) {
  for (const int cells : {1, 4, 16}) {
    StillWorld w;
    w.add(treeShape(plainTree(cuboid({8, 8, 1}, cells))), 0, btVector3(0, 0, btScalar(-0.5)));
    btRigidBody& body = w.add(gimpactMesh(block(), kMargin), 1, btVector3(btScalar(0.3), 0, btScalar(0.145)));
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(120);
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.15, 0.003) << cells;
  }
}

// Solvers move bodies that are deep in others, whatever their speeds.
TEST(MeshPressedIn, IsNotForgotten) {
  for (const btScalar depth : {btScalar(0.025), btScalar(0.05), btScalar(0.1)}) {
    StillWorld w;
    w.add(treeShape(plainTree(cuboid({8, 8, 1}, 4))), 0, btVector3(0, 0, btScalar(-0.5)));
    btRigidBody& body = w.add(gimpactMesh(block(), kMargin), 1, btVector3(0, 0, btScalar(0.15)));
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(60);
    body.translate(btVector3(0, 0, -depth));
    w.step(120);
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.15, 0.003) << depth;
  }
}

Solid togetherAt(const std::vector<std::pair<Solid, Vec3d>>& parts) {
  Solid all;
  for (const auto& [part, at] : parts) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (const Vec3d& v : part.vertices) all.vertices.push_back(v + at);
    for (const auto& t : part.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

// Its top lies on the beam, its legs hang beside it: seen along the beam's underside all of it is behind, or beside.
TEST(MeshOverABeam, Hangs) {
  constexpr double kHeight = 1, kThickness = 0.1, kWidth = 0.5;
  const double rest = -(kHeight / 2 - kThickness);
  const Solid channel = togetherAt(
      {{cuboid({kWidth, 0.4, kThickness}, 1), {0, 0, (kHeight - kThickness) / 2}},
       {cuboid({kThickness, 0.4, kHeight - kThickness}, 1), {(kThickness - kWidth) / 2, 0, -kThickness / 2}},
       {cuboid({kThickness, 0.4, kHeight - kThickness}, 1), {(kWidth - kThickness) / 2, 0, -kThickness / 2}}});
  for (const int cells : {1, 4, 8, 16})
    for (const double fall : {0.002, 0.018, 0.042, 0.05}) {
      StillWorld w;
      w.add(treeShape(plainTree(cuboid({0.1, 4, 0.1}, cells))), 0, btVector3(0, 0, btScalar(-0.05)));
      btRigidBody& body = w.add(gimpactMesh(channel, kMargin), 1, btVector3(0, 0, btScalar(rest + fall)));
      body.setActivationState(DISABLE_DEACTIVATION);
      w.step(120);
      EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), rest, 0.005) << cells << " cells, " << fall;
    }
}

// A floor and a roof that face the same way, in one leaf.
TEST(MeshOnShelves, LiesOnTheLower) {
  const Solid shelves = togetherAt({{cuboid({3, 3, 0.3}, 1), {0, 0, -0.15}}, {cuboid({3, 3, 0.3}, 1), {0, 0, 2.15}}});
  for (const std::uint32_t perLeaf : {1U, 2U, 4U}) {
    StillWorld w;
    w.add(treeShape(plainTree(shelves, perLeaf)), 0, btVector3(0, 0, 0));
    btRigidBody& body =
        w.add(gimpactMesh(block(), kMargin), 1, btVector3(btScalar(0.3), btScalar(0.2), btScalar(0.16)));
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(120);
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.15, 0.003) << perLeaf;
  }
}

// A body that lay on a slab and was carried below it comes from below.
TEST(MeshCarriedBelow, DoesNotPassThroughFromThere) {
  for (const int cells : {1, 4, 16}) {
    StillWorld w;
    w.add(treeShape(plainTree(cuboid({8, 8, 1}, cells))), 0, btVector3(0, 0, btScalar(-0.5)));
    btRigidBody& body = w.add(gimpactMesh(block(), kMargin), 1, btVector3(0, 0, btScalar(0.16)));
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(30);
    body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.4), btScalar(0.3), -2)));
    body.setLinearVelocity(btVector3(0, 0, 12));
    w.step(30);
    EXPECT_LT(body.getWorldTransform().getOrigin().z(), -1) << cells;
  }
}

// A tree of fifty metres does not make a stone of ten centimetres near to anything half a metre away.
TEST(SmallMesh, ComesToRestOnAnyTree) {
  constexpr btScalar kStill = btScalar(0.005);
  for (const double width : {5.0, 50.0, 200.0})
    for (const int cells : {1, 8}) {
      StillWorld w;
      w.add(treeShape(plainTree(cuboid({width, width, width / 10}, cells))), 0, btVector3(0, 0, btScalar(-width / 20)));
      btRigidBody& body = w.add(gimpactMesh(cuboid({0.1, 0.08, 0.06}, 2), kMargin), 1,
                                btVector3(btScalar(0.3), btScalar(0.2), btScalar(0.08)));
      body.setActivationState(DISABLE_DEACTIVATION);
      w.step(180);
      EXPECT_LT(body.getLinearVelocity().length(), kStill) << width << " m, " << cells << " cells";
      EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.03, 0.002) << width << " m, " << cells << " cells";
    }
}

// Points of a fast spinning body sink by more in a step than the body does.
TEST(SpinningMesh, GoesThroughNoThinSlab) {
  constexpr int kSeeds = 6;
  const auto [ring, rod] = std::pair(torus(0.4, 0.12, 24), cuboid({1, 0.15, 0.15}, 4));
  for (const double thickness : {0.2, 0.4})
    for (const int cells : {1, 8, 32}) {
      const auto slab = treeShape(plainTree(cuboid({8, 8, thickness}, cells)));
      for (int seed = 0; seed < kSeeds; ++seed) {
        std::mt19937 engine(static_cast<std::uint32_t>(seed));
        std::uniform_real_distribution<float> uniform(-1, 1);
        const auto number = [&] { return btScalar(uniform(engine)); };
        StillWorld w;
        w.add(slab, 0, btVector3(0, 0, btScalar(-thickness / 2)));
        const btQuaternion turned = btQuaternion{number(), number(), number(), btScalar(1.1)}.normalized();
        btRigidBody& body = w.add(gimpactMesh(seed % 2 ? rod : ring, kMargin), 1, btVector3(0, 0, 1), turned);
        body.setActivationState(DISABLE_DEACTIVATION);
        body.setLinearVelocity(btVector3(0, 0, -3));
        body.setAngularVelocity(btVector3{number(), number(), number()} * 8);
        w.step(180);
        EXPECT_GT(body.getWorldTransform().getOrigin().z(), 0.05)
            << thickness << " m, " << cells << " cells, seed " << seed;
      }
    }
}

// As deep as a solver leaves what it has caught.
TEST(RoundMeshSetDown, ComesOut) {
  const std::pair<Solid, double> all[] = {{ball(0.3, 8), 0.3}, {torus(0.4, 0.12, 24), 0.12}};
  for (const auto& [solid, height] : all)
    for (const int cells : {1, 4, 16})
      for (const double depth : {0.0015, 0.003, 0.006, 0.01}) {
        StillWorld w;
        w.add(treeShape(plainTree(cuboid({8, 8, 1}, cells))), 0, btVector3(0, 0, btScalar(-0.5)));
        btRigidBody& body = w.add(gimpactMesh(solid, kMargin), 1, btVector3(0, 0, btScalar(height - depth)));
        body.setActivationState(DISABLE_DEACTIVATION);
        w.step(180);
        // A facet lies lower than the ball.
        EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), height, 0.0015 + 0.02 * height)
            << height << ", " << cells << " cells, " << depth;
      }
}

// A query has no steps before it: all of what it finds is new.
TEST(MeshInATree, IsToldAsDeepAsItIs) {
  const std::pair<Solid, double> all[] = {{ball(0.3, 8), 0.3}, {torus(0.4, 0.12, 24), 0.12}, {block(), 0.15}};
  for (const auto& [solid, height] : all)
    for (const int cells : {1, 4, 16})
      for (const double depth : {0.002, 0.01, 0.04}) {
        StillWorld w;
        btRigidBody& ground = w.add(treeShape(plainTree(cuboid({8, 8, 1}, cells))), 0, btVector3(0, 0, btScalar(-0.5)));
        btRigidBody& body = w.add(gimpactMesh(solid, kMargin), 1, btVector3(0, 0, btScalar(height - depth)));
        DeepestContact deepest;
        w.world.contactPairTest(&ground, &body, deepest);
        EXPECT_NEAR(deepest.separation, -depth, 2 * double(kMargin)) << height << ", " << cells << " cells, " << depth;
      }
}

// A blade a program swings: its speeds tell how far it goes in a step.
TEST(KinematicMesh, PushesWhatItStrikes) {
  for (const int cells : {1, 8}) {
    StillWorld w;
    w.world.setGravity(btVector3(0, 0, 0));
    btRigidBody& plate = w.add(treeShape(plainTree(cuboid({2, 2, 0.2}, cells))), 1, btVector3(0, 0, 0));
    plate.setActivationState(DISABLE_DEACTIVATION);
    btRigidBody& blade = w.add(gimpactMesh(cuboid({0.6, 0.2, 0.1}, 2), kMargin), 0, btVector3(0, 0, btScalar(0.4)));
    blade.setCollisionFlags(blade.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    blade.setActivationState(DISABLE_DEACTIVATION);
    for (int i = 0; i < 30; ++i) {
      btTransform at = blade.getWorldTransform();
      at.getOrigin() -= btVector3(0, 0, btScalar(0.04));
      blade.setWorldTransform(at);
      w.step(1);
    }
    EXPECT_LT(plate.getLinearVelocity().z(), -1) << cells;
    EXPECT_LT(plate.getWorldTransform().getOrigin().z(), blade.getWorldTransform().getOrigin().z()) << cells;
  }
}

}  // namespace
}  // namespace cairn::test::mesh_on_tree_test
