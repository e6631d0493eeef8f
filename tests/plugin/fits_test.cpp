// SPDX-License-Identifier: Zlib
// Pieces that fit with a little play go together, slide and stay as pieces do: facing walls that are apart are apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bullet_world.h"
#include "extruded.h"
#include "triangle_grounds.h"
#include "turned.h"

namespace cairn::test::fits_test {
namespace {

constexpr double kG = 10;

enum class FixedAs { tree, mesh };

struct Fit {
  BulletWorld<> w;

  // The static body is a tree, or one of Bullet's own meshes.
  explicit Fit(FixedAs fixedAs = FixedAs::tree) : fixedAs_(fixedAs) {
    w.world.setGravity(btVector3(0, 0, btScalar(-kG)));
  }
  void fix(const Solid& solid) {
    if (fixedAs_ == FixedAs::tree)
      add(solid, 0, 1, btTransform::getIdentity());
    else
      w.add(bvhMesh(solid), 0, btVector3(0, 0, 0)).setFriction(1);
  }
  // In the solid's own frame.
  btRigidBody& add(const Solid& solid, btScalar mass, btScalar friction, const btTransform& place) {
    auto created = bullet::SphereTreeShape::create(plainTree(solid, 4), bullet::BodyFrame::principalAxes);
    std::shared_ptr<bullet::SphereTreeShape> tree = std::move(created).value();
    fromMesh_.push_back(tree->bodyFromMesh());
    const btTransform body = place * tree->bodyFromMesh().inverse();
    btRigidBody& added = w.add(tree, mass, body.getOrigin(), body.getRotation());
    added.setFriction(friction);
    added.setUserIndex(int(fromMesh_.size()) - 1);
    return added;
  }
  btTransform poseOf(const btRigidBody& body) const {
    return body.getWorldTransform() * fromMesh_[std::size_t(body.getUserIndex())];
  }
  btVector3 placeOf(const btRigidBody& body) const { return poseOf(body).getOrigin(); }
  double deepest() {
    double depth = 0;
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(i);
      for (int k = 0; k < manifold.getNumContacts(); ++k)
        depth = std::max(depth, -double(manifold.getContactPoint(k).getDistance()));
    }
    return depth;
  }

 private:
  FixedAs fixedAs_;
  std::vector<btTransform> fromMesh_;
};

class Fits : public testing::TestWithParam<FixedAs> {};
INSTANTIATE_TEST_SUITE_P(FixedAs, Fits, testing::Values(FixedAs::tree, FixedAs::mesh),
                         [](const auto& fixed) { return fixed.param == FixedAs::tree ? "Tree" : "Mesh"; });

btTransform at(double x, double y, double z, const btQuaternion& turn = btQuaternion::getIdentity()) {
  return btTransform(turn, btVector3(btScalar(x), btScalar(y), btScalar(z)));
}

// Into holes one and five per cent wider than it, from beside the middle and tilted.
TEST_P(Fits, APegFallsIntoItsHole) {
  for (const double play : {0.01, 0.05})
    for (int start = 0; start < 4; ++start) {
      Fit fit(GetParam());
      fit.fix(holedBlock(0.5, 0.2 * (1 + play), 32, -0.3, 0.3));
      const double angle = start * 1.7, off = 0.0005 * start, tilt = 0.0012 * start;
      btRigidBody& peg =
          fit.add(extruded(circle(0.2, 32), -0.4, 0.4), 1, btScalar(0.1),
                  at(off * std::cos(angle), off * std::sin(angle), 0.72,
                     btQuaternion(btVector3(btScalar(std::cos(angle)), btScalar(std::sin(angle)), 0), btScalar(tilt))));
      btScalar aside = 0;
      for (int step = 0; step < 60 && fit.placeOf(peg).z() > 0; ++step) {
        fit.w.step();
        aside = std::max({aside, std::abs(peg.getLinearVelocity().x()), std::abs(peg.getLinearVelocity().y())});
      }
      EXPECT_LT(fit.placeOf(peg).z(), 0) << "play " << play << ", start " << start;
      EXPECT_LT(aside, 0.05) << "pushed aside, play " << play << ", start " << start;
    }
}

// A T in its rail, on top of it and hanging from it, slides as a block on a slope does.
TEST_P(Fits, ASliderStaysOnItsRail) {
  const Outline rail{{-0.1, 0},   {0.1, 0},     {0.1, 0.2},   {0.25, 0.2},
                     {0.25, 0.4}, {-0.25, 0.4}, {-0.25, 0.2}, {-0.1, 0.2}};
  const Outline slider{{-0.5, 0.02}, {-0.11, 0.02}, {-0.11, 0.19}, {-0.26, 0.19}, {-0.26, 0.41}, {0.26, 0.41},
                       {0.26, 0.19}, {0.11, 0.19},  {0.11, 0.02},  {0.5, 0.02},   {0.5, 0.7},    {-0.5, 0.7}};
  const double slope = 0.35;
  for (const double up : {1.0, -1.0})
    for (const double friction : {0.0, 0.3}) {
      Fit fit(GetParam());
      fit.w.world.setGravity(btVector3(0, btScalar(-up * kG * std::cos(slope)), btScalar(kG * std::sin(slope))));
      fit.fix(extruded(rail, -2, 2));
      btRigidBody& body = fit.add(extruded(slider, -0.3, 0.3), 1, btScalar(friction), at(0, 0, -1.5));
      btScalar aside = 0;
      for (int step = 0; step < 72; ++step) {
        fit.w.step();
        aside = std::max({aside, std::abs(fit.placeOf(body).x()), std::abs(fit.placeOf(body).y())});
      }
      const double way = double(fit.placeOf(body).z()) + 1.5;
      const double theory = kG * (std::sin(slope) - friction * std::cos(slope)) * 1.2 * 1.2 / 2;
      EXPECT_NEAR(way, theory, 0.03 * theory) << "up " << up << ", friction " << friction;
      EXPECT_LT(aside, 0.012) << "its play is 0.01; up " << up << ", friction " << friction;
    }
}

// In a slot of its own outline, 0.006 wider all around.
TEST_P(Fits, AKeySlidesIntoItsLock) {
  const Outline key{{-0.1, -0.3}, {0.1, -0.3}, {0.1, -0.1}, {0.25, -0.1},
                    {0.25, 0.05}, {0.1, 0.05}, {0.1, 0.3},  {-0.1, 0.3}};
  // The lock's outline runs around the slot and out along a seam without width, as two halves.
  const Outline right{{0.106, -0.306}, {0.5, -0.306},  {0.5, 0.306},    {0.106, 0.306},
                      {0.106, 0.056},  {0.256, 0.056}, {0.256, -0.106}, {0.106, -0.106}};
  const Outline left{{-0.5, -0.306}, {-0.106, -0.306}, {-0.106, 0.306}, {-0.5, 0.306}};
  Fit fit(GetParam());
  fit.fix(extruded(right, -0.25, 0.25));
  fit.fix(extruded(left, -0.25, 0.25));
  btRigidBody& body = fit.add(extruded(key, -0.6, 0.6), 1, btScalar(0.1), at(0, 0, 0.75));
  fit.w.step(18);
  EXPECT_LT(fit.placeOf(body).z(), 0.75 - 0.4);
  EXPECT_LT(std::hypot(fit.placeOf(body).x(), fit.placeOf(body).y()), 0.006);
  EXPECT_LT(body.getAngularVelocity().length(), 0.01);
}

// Facing walls a hundredth apart: in a cavity of its own outline a body touches nothing.
TEST_P(Fits, ABodyInACavityDoesNotTouchIt) {
  Fit fit(GetParam());
  fit.fix(holedBlock(0.5, 0.21, 32, -0.3, 0.3));
  fit.add(extruded(circle(0.2, 32), -0.25, 0.25), 1, 1, at(0, 0, 0));
  fit.w.world.setGravity(btVector3(0, 0, 0));
  fit.w.step(2);
  EXPECT_EQ(fit.w.dispatcher.lastStep().contacts, 0U);
}

// A plate that comes farther in a step than it is thick takes along what it meets.
TEST(ThinWall, IsNotCrossedByWhatIsFasterThanItIsThick) {
  for (const double speed : {0.5, 1.0, 1.5, 2.0}) {
    Fit fit;
    fit.w.world.setGravity(btVector3(0, 0, 0));
    constexpr double kThick = 0.01;
    btRigidBody& plate = fit.add(cuboid({1, 1, kThick}, 8), 0, 1, at(0, 0, 0));
    plate.setCollisionFlags(plate.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    plate.setActivationState(DISABLE_DEACTIVATION);
    btRigidBody& body = fit.add(ball(0.02, 6), 1, 0, at(0.013, 0.02, 0.3));
    double height = 0;
    for (int step = 0; step < 120; ++step) {
      height += speed / 60;
      plate.setLinearVelocity(btVector3(0, 0, btScalar(speed)));
      plate.setInterpolationWorldTransform(plate.getWorldTransform());
      plate.setInterpolationLinearVelocity(plate.getLinearVelocity());
      btTransform place = plate.getWorldTransform();
      place.getOrigin().setZ(btScalar(height));
      plate.setWorldTransform(place);
      fit.w.step();
    }
    EXPECT_GT(double(fit.placeOf(body).z()), height) << speed << " m/s";
  }
}

// Walls ahead that do not close must not take the places of the rim that does.
TEST(ThinWall, StopsALidOnTheRimOfItsJar) {
  constexpr double kWall = 0.01, kPlay = 0.0036;
  const Solid jar = turnedAround({{0, 0}, {0.3, 0}, {0.3, 0.5}, {0.28, 0.5}, {0.28, 0.02}, {0, 0.02}}, 48);
  const double in = 0.3 + kPlay, out = in + kWall, roof = 0.15 - kWall;
  const Solid lid = turnedAround({{0, roof}, {in, roof}, {in, 0}, {out, 0}, {out, 0.15}, {0, 0.15}}, 48);
  for (int start = 0; start < 10; ++start) {
    Fit fit;
    fit.add(jar, 0, btScalar(0.3), at(0, 0, 0));
    btRigidBody& body = fit.add(lid, btScalar(0.1), btScalar(0.2), at(0.0012, 0.0003, 0.5 + 0.004 * start));
    btScalar lowest = 1;
    for (int step = 0; step < 100; ++step) {
      fit.w.step();
      lowest = std::min(lowest, fit.placeOf(body).z());
    }
    EXPECT_GT(double(lowest) + roof, 0.5 - 0.2 * kWall) << "from " << 0.5 + 0.004 * start;
    EXPECT_LT(double(fit.placeOf(body).z()) + roof, 0.5 + 0.2 * kWall) << "from " << 0.5 + 0.004 * start;
  }
}

// Its end turns by more than three walls a step, whichever of the bodies is the pair's first.
TEST(ThinWall, TakesBallsAlongThatItTurnsInto) {
  constexpr double kThick = 0.02, kRadius = 0.03, kSpin = 4;
  for (const bool isFirst : {true, false}) {
    Fit fit;
    fit.w.world.setGravity(btVector3(0, 0, 0));
    std::vector<btRigidBody*> balls;
    btRigidBody* blade = nullptr;
    const auto addBlade = [&] { blade = &fit.add(cuboid({2, kThick, 0.6}, 8), 50, 0, at(0, 0, 0)); };
    if (isFirst) addBlade();
    for (int i = 0; i < 6; ++i) {
      const double far = 0.4 + 0.1 * i, angle = 0.5 + 0.1 * i;
      balls.push_back(
          &fit.add(ball(kRadius, 8), btScalar(0.05), 0, at(far * std::cos(angle), far * std::sin(angle), 0)));
    }
    if (!isFirst) addBlade();
    btHingeConstraint hinge(*blade, btVector3(0, 0, 0), btVector3(0, 0, 1) * blade->getWorldTransform().getBasis());
    fit.w.world.addConstraint(&hinge);
    blade->setAngularVelocity(btVector3(0, 0, btScalar(kSpin)));
    std::vector<bool> passed(balls.size());
    for (int step = 0; step < 40; ++step) {
      fit.w.step();
      for (std::size_t i = 0; i < balls.size(); ++i) {
        const btVector3 place = fit.poseOf(*blade).invXform(fit.placeOf(*balls[i]));
        if (place.x() < 1 && double(place.y()) < -kThick / 2) passed[i] = true;  // and did not slide off the end
      }
    }
    EXPECT_EQ(std::ranges::count(passed, true), 0) << "blade first " << isFirst;
    fit.w.world.removeConstraint(&hinge);
  }
}

// A push is no longer than the wall is thick, however high the wall stands around. Points that follow their bodies may
// be a little deeper.
TEST(ThinWall, OfACupDoesNotThrowOutTheOneThatFallsIntoIt) {
  constexpr double kWall = 0.02;
  const Solid cup =
      turnedAround({{0, 0}, {0.3, 0}, {0.4, 0.6}, {0.4 - kWall, 0.6}, {0.3 - kWall, kWall}, {0, kWall}}, 32);
  for (const double speed : {0.5, 1.5})
    for (const double tilt : {0.0, 0.1, 0.2, 0.3})
      for (const double aside : {0.0, 0.03, 0.06}) {
        SCOPED_TRACE(testing::Message() << speed << " m/s, tilt " << tilt << ", aside " << aside);
        Fit fit;
        fit.add(cup, 0, btScalar(0.3), at(0, 0, 0));
        const btQuaternion turn(btVector3(btScalar(0.2), 1, 0).normalized(), btScalar(tilt));
        btRigidBody& body =
            fit.add(cup, btScalar(0.1), btScalar(0.3), at(aside, 0.02, 0.61 + 0.3 * std::sin(tilt), turn));
        body.setLinearVelocity(btVector3(0, 0, btScalar(-speed)));
        double deepest = 0;
        for (int step = 0; step < 300; ++step) {
          fit.w.step();
          deepest = std::max(deepest, fit.deepest());
        }
        EXPECT_LT(deepest, 1.2 * kWall);
        EXPECT_NEAR(double(fit.placeOf(body).z()), kWall * std::hypot(1, 6), kWall) << "stands in it";
      }
}

// A tongue in a groove, pulled at: it holds by its shoulders, within its play.
TEST(Fits, ATongueHoldsInItsGroove) {
  const Outline tongue{{-0.5, -0.4}, {0, -0.4}, {0, -0.1}, {0.2, -0.2}, {0.2, 0.2}, {0, 0.1}, {0, 0.4}, {-0.5, 0.4}};
  const double play = 0.006;
  const Outline groove{{0.7, 0.4},
                       {play, 0.4},
                       {play, 0.1 + play},
                       {0.2 + play, 0.2 + 2 * play},
                       {0.2 + play, -0.2 - 2 * play},
                       {play, -0.1 - play},
                       {play, -0.4},
                       {0.7, -0.4}};
  Fit fit;
  fit.w.world.setGravity(btVector3(0, 0, 0));
  fit.add(extruded(groove, -0.1, 0.1), 0, btScalar(0.4), at(0, 0, 0));
  btRigidBody& body = fit.add(extruded(tongue, -0.1, 0.1), 1, btScalar(0.4), at(0, 0, 0));
  fit.w.step(60);
  EXPECT_LT(body.getLinearVelocity().length(), 0.02) << "without force";
  for (int step = 0; step < 120; ++step) {
    body.activate();
    body.applyCentralForce(btVector3(-20, 0, 0));
    fit.w.step();
  }
  EXPECT_GT(fit.placeOf(body).x(), -0.03);
  EXPECT_LT(body.getLinearVelocity().length(), 0.02);
}

}  // namespace
}  // namespace cairn::test::fits_test
