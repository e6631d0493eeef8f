// SPDX-License-Identifier: Zlib
// Roughness: how far normals are tilted, that it spreads bounces, and that it harms no other body.
#include "cairn/effects/surface_roughness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cairn/effects/restitution.h"
#include "slope_world.h"

namespace cairn::test::surface_roughness_test {
namespace {

using effects::SurfaceRoughness;

constexpr btScalar kRadius = btScalar(0.5);
const btScalar kVolume = SIMD_PI * 4 / 3 * kRadius * kRadius * kRadius;

TEST(SurfaceRoughness, TiltsByAnglesUniformUpToTheGreatest) {
  const SurfaceRoughness effect({}, 7);
  const btVector3 normal = btVector3(1, 2, 3).normalized();
  constexpr btScalar kMax = btScalar(0.4);
  constexpr int kDraws = 20000;
  double sum = 0, most = 0;
  btVector3 mean(0, 0, 0);
  for (int i = 0; i < kDraws; ++i) {
    const btVector3 tilted = effect.tilted(normal, kMax, 3, static_cast<std::uint64_t>(i));
    EXPECT_NEAR(tilted.length(), 1, 1e-5);
    const double angle = std::acos(std::min(1.0, double(tilted.dot(normal))));
    sum += angle;
    most = std::max(most, angle);
    mean += tilted - normal * tilted.dot(normal);
  }
  // Five standard errors of a mean of uniform angles, and of directions of at most unit length.
  EXPECT_NEAR(sum / kDraws, kMax / 2, 5 * kMax / std::sqrt(12.0 * kDraws));
  EXPECT_LE(most, kMax + 1e-3);
  EXPECT_GT(most, 0.99 * kMax);
  EXPECT_LT((mean / kDraws).length(), 5 * kMax / std::sqrt(double(kDraws)));
}

TEST(SurfaceRoughness, SpreadsWhatFallsStraight) {
  const auto sideways = [](btScalar height) {
    SlopeWorld world;
    world.add<effects::Restitution>(effects::PairTable<btScalar>(btScalar(0.6)), effects::restitution::Constant{});
    world.add<SurfaceRoughness>(std::vector<btScalar>{0, height}, 1);
    double sum = 0;
    constexpr int kBalls = 40;
    std::vector<btRigidBody*> balls;
    for (int i = 0; i < kBalls; ++i)
      balls.push_back(&world.addBody(std::make_shared<btSphereShape>(kRadius), 5,
                                     btVector3(btScalar(50 * i), 0, kRadius + 2), kVolume));
    world.run(btScalar(1.2));
    for (int i = 0; i < kBalls; ++i) {
      const btVector3 way =
          balls[static_cast<std::size_t>(i)]->getWorldTransform().getOrigin() - btVector3(btScalar(50 * i), 0, 0);
      sum += double(way.x() * way.x() + way.y() * way.y());
    }
    return std::sqrt(sum / kBalls);
  };
  const double smooth = sideways(0), rough = sideways(btScalar(0.05)), rougher = sideways(btScalar(0.2));
  std::printf("spread after a bounce: %.3f, %.3f, %.3f m\n", smooth, rough, rougher);
  EXPECT_LT(smooth, 1e-3);
  EXPECT_GT(rough, 0.02);
  EXPECT_GT(rougher, 2 * rough);
}

TEST(SurfaceRoughness, OfOneBodyDoesNotDependOnOthers) {
  const auto hashWith = [](bool another) {
    SlopeWorld world;
    world.add<effects::Restitution>(effects::PairTable<btScalar>(btScalar(0.6)), effects::restitution::Constant{});
    world.add<SurfaceRoughness>(std::vector<btScalar>{0, btScalar(0.1)}, 1);
    btRigidBody& ball =
        world.addBody(std::make_shared<btSphereShape>(kRadius), 5, btVector3(0, 0, kRadius + 2), kVolume);
    if (another)
      world.addBody(std::make_shared<btSphereShape>(kRadius), 5, btVector3(100, 0, kRadius + btScalar(1.7)), kVolume);
    StateHash hash;
    for (int i = 0; i < 480; ++i) {
      world.runStep();
      addState(hash, ball);
    }
    return hash.hex();
  };
  EXPECT_EQ(hashWith(false), hashWith(true));
}

TEST(SurfaceRoughness, GivesTheNormalsBack) {
  SlopeWorld world;
  world.add<effects::Restitution>(effects::PairTable<btScalar>(btScalar(0.6)), effects::restitution::Constant{});
  world.add<SurfaceRoughness>(std::vector<btScalar>{0, btScalar(0.2)}, 1);
  world.addBody(std::make_shared<btSphereShape>(kRadius), 5, btVector3(0, 0, kRadius + 2), kVolume);
  for (int i = 0; i < 480; ++i) {
    world.runStep();
    for (int m = 0; m < world.bullet.dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *world.bullet.dispatcher.getManifoldByIndexInternal(m);
      for (int c = 0; c < manifold.getNumContacts(); ++c)
        EXPECT_EQ(std::abs(manifold.getContactPoint(c).m_normalWorldOnB.z()), 1);
    }
  }
  EXPECT_GT(world.set().report()[1].acted, 0U);
}

}  // namespace
}  // namespace cairn::test::surface_roughness_test
