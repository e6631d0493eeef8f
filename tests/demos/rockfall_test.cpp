// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/rockfall/rockfall.h"

#include <gtest/gtest.h>

#include <BulletCollision/CollisionShapes/btTriangleCallback.h>

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "scene_trees.h"
#include "scenes/figures/random.h"

namespace cairn::scenes::rockfall_test {
namespace {

/// Height of the collision mesh over a point, straight from its triangles.
class HeightProbe : public btTriangleCallback {
 public:
  HeightProbe(double x, double y) : x_(x), y_(y) {}
  void processTriangle(btVector3* t, int, int) override {
    const double ux = t[1].x() - t[0].x(), uy = t[1].y() - t[0].y(), vx = t[2].x() - t[0].x(), vy = t[2].y() - t[0].y();
    const double px = x_ - t[0].x(), py = y_ - t[0].y(), area = ux * vy - uy * vx;
    const double a = (px * vy - py * vx) / area, b = (ux * py - uy * px) / area;
    if (a < -kEdge || b < -kEdge || a + b > 1 + kEdge) return;
    height = t[0].z() + a * (t[1].z() - t[0].z()) + b * (t[2].z() - t[0].z());
    facesUp = area > 0;
    ++hits;
  }
  double height = 0;
  bool facesUp = false;
  int hits = 0;

 private:
  static constexpr double kEdge = 1e-9;
  double x_, y_;
};

TEST(Slope_HeightAt, IsTheCollisionMeshAndFacesUp) {
  Slope slope(3);
  Random random(8);
  for (int i = 0; i < 500; ++i) {
    const double x = random.uniform(-1.9, 67), y = random.uniform(-10, 10);
    HeightProbe probe(x, y);
    slope.shape().processAllTriangles(&probe, btVector3(btScalar(x), btScalar(y), -10),
                                      btVector3(btScalar(x), btScalar(y), 60));
    ASSERT_GE(probe.hits, 1);
    EXPECT_TRUE(probe.facesUp);
    // Single precision over heights up to 32 m, divided by cells of half a metre.
    EXPECT_NEAR(slope.heightAt(x, y), probe.height, 1e-4);
  }
}

/// Small rocks pass their own radius in the fewest steps.
constexpr double kSmall = 0.4, kLarge = 1.1;

std::unique_ptr<Rockfall> makeRockfall(const RockfallOptions& options, double size = kSmall,
                                       const std::shared_ptr<const SphereTree>& tree = test::smallRockTree()) {
  auto scene = Rockfall::create(makeModel(tree, size), options);
  EXPECT_TRUE(scene) << scene.error().message;
  return std::move(scene).value();
}

std::string hashAfter(Rockfall& scene, std::uint32_t steps) {
  for (std::uint32_t i = 0; i < steps; ++i) scene.step();
  StateHash hash;
  scene.world().addState(hash);
  return hash.hex();
}

TEST(Rockfall_UnderABudget, LosesNoRockAndMovesDownhill) {
  RockfallOptions options;
  options.rocks = 20;
  options.world.budget.operations = 5000;
  const auto scene = makeRockfall(options);
  double startX = 0, endX = 0;
  for (const btRigidBody* rock : scene->world().bodies()) startX += rock->getWorldTransform().getOrigin().x();
  for (std::uint32_t second = 0; second < 6; ++second) {
    for (std::uint32_t i = 0; i < Rockfall::kStepsPerSecond; ++i) scene->step();
    ASSERT_EQ(scene->countLost(), 0U) << "after second " << second;
  }
  for (const btRigidBody* rock : scene->world().bodies()) endX += rock->getWorldTransform().getOrigin().x();
  EXPECT_GT(endX, startX + 10);
}

/// Nothing is ever refined: the ground is held by spheres of whole rocks, through many gatherings of its triangles.
TEST(Rockfall_WithoutAnyBudget, LosesNoRock) {
  RockfallOptions options;
  options.rocks = 30;
  options.world.budget.operations = 0;
  const auto scene = makeRockfall(options);
  for (std::uint32_t second = 0; second < 20; ++second) {
    for (std::uint32_t i = 0; i < Rockfall::kStepsPerSecond; ++i) scene->step();
    ASSERT_EQ(scene->countLost(), 0U) << "after second " << second;
  }
}

/// Many rocks on each other, fine trees: what a coarse tree's fat spheres forgive shows here.
TEST(Rockfall_OfFineTrees, LosesNoRock) {
  RockfallOptions options;
  options.rocks = 72;
  const auto scene = makeRockfall(options, kLarge, test::fineRockTree());
  for (std::uint32_t second = 0; second < 5; ++second) {
    for (std::uint32_t i = 0; i < Rockfall::kStepsPerSecond; ++i) scene->step();
    ASSERT_EQ(scene->countLost(), 0U) << "after second " << second;
  }
}

TEST(Rockfall_SameSeed, GivesTheSameBitsTwice) {
  RockfallOptions options;
  options.rocks = 8;
  options.world.budget.operations = 2000;
  const std::string first = hashAfter(*makeRockfall(options), 180);
  EXPECT_EQ(hashAfter(*makeRockfall(options), 180), first);
  options.seed = 2;
  EXPECT_NE(hashAfter(*makeRockfall(options), 180), first);
}

TEST(Rockfall_ARockBelowTheGround, IsCountedAsLost) {
  RockfallOptions options;
  options.rocks = 3;
  const auto scene = makeRockfall(options);
  EXPECT_EQ(scene->countLost(), 0U);
  btTransform pose = btTransform::getIdentity();
  pose.setOrigin(toBullet({50, 0, scene->slope().heightAt(50, 0) - 0.1}));
  scene->world().bodies()[1]->setWorldTransform(pose);
  EXPECT_EQ(scene->countLost(), 1U);
}

}  // namespace
}  // namespace cairn::scenes::rockfall_test
