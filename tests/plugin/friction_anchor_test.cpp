// SPDX-License-Identifier: Zlib
// Bodies that ask Bullet for friction anchors stay where they came to rest, on slopes too, and do not sink.
#include <gtest/gtest.h>

#include <array>

#include "bullet_world.h"
#include "gimpact_mesh.h"

namespace cairn::test::friction_anchor_test {
namespace {

enum class Kind { tree, box, plane, gimpact };

void PrintTo(Kind kind, std::ostream* out) {
  constexpr std::array kNames{"tree", "box", "plane", "gimpact"};
  *out << kNames.at(static_cast<std::size_t>(kind));
}

const Vec3d kSize{1, 0.4, 0.3};
constexpr double kGround = 16;

std::shared_ptr<btCollisionShape> shapeOf(Kind kind, const Vec3d& size, int cells) {
  if (kind == Kind::plane) return std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(size.z / 2));
  if (kind == Kind::box)
    return std::make_shared<btBoxShape>(btVector3(btScalar(size.x), btScalar(size.y), btScalar(size.z)) *
                                        btScalar(0.5));
  if (kind == Kind::gimpact) return gimpactMesh(cuboid(size, cells), btScalar(0.001));
  return treeShape(plainTree(cuboid(size, cells)));
}

struct End {
  double lowest, crept;  // metres: over the ground's surface, and along it in the last four seconds
};

// Dropped a little tilted, and left alone for eight seconds.
End fall(Kind mover, Kind ground, double slope, bool isAnchored) {
  BulletWorld<> w;
  const btQuaternion turn(btVector3(0, 1, 0), btScalar(slope));
  const Vec3d slab{kGround, kGround, 1};
  btRigidBody& below = w.add(shapeOf(ground, slab, 8), 0, btVector3(0, 0, 0), turn);
  btRigidBody& body = w.add(shapeOf(mover, kSize, 2), 1, quatRotate(turn, btVector3(0.1F, 0.1F, 0.85F)),
                            turn * btQuaternion(btVector3(1, 0.2F, 0), 0.3F));
  for (btRigidBody* each : {&below, &body}) {
    each->setFriction(1);
    if (isAnchored) each->setCollisionFlags(each->getCollisionFlags() | btCollisionObject::CF_HAS_FRICTION_ANCHOR);
  }
  body.setActivationState(DISABLE_DEACTIVATION);
  w.step(240);
  const btVector3 before = body.getWorldTransform().getOrigin();
  w.step(240);
  End end{1e9, double((body.getWorldTransform().getOrigin() - before).length())};
  for (int c = 0; c < 8; ++c) {
    const btVector3 corner(btScalar(c & 1 ? 0.5 : -0.5) * btScalar(kSize.x),
                           btScalar(c & 2 ? 0.5 : -0.5) * btScalar(kSize.y),
                           btScalar(c & 4 ? 0.5 : -0.5) * btScalar(kSize.z));
    const btVector3 seen = quatRotate(turn.inverse(), body.getWorldTransform() * corner);
    end.lowest = std::min(end.lowest, double(seen.z()) - slab.z / 2);
  }
  return end;
}

// A body at rest is as deep as Bullet leaves one without an anchor: a few tenths of a millimetre.
constexpr double kRestTolerance = 1e-3;
// An anchored body hangs by its friction's spring; what creeps without one does so by a millimetre a second.
constexpr double kCreepTolerance = 1e-3;

class Anchored : public testing::TestWithParam<std::tuple<Kind, Kind, double>> {};

TEST_P(Anchored, StaysWhereItCameToRest) {
  const auto& [mover, ground, slope] = GetParam();
  const End end = fall(mover, ground, slope, true), loose = fall(mover, ground, slope, false);
  std::printf("lowest %.2f mm, crept %.2f mm; without anchors %.2f, %.2f\n", 1e3 * end.lowest, 1e3 * end.crept,
              1e3 * loose.lowest, 1e3 * loose.crept);
  EXPECT_GT(end.lowest, -kRestTolerance);
  EXPECT_LT(end.lowest, kRestTolerance);
  EXPECT_LT(end.crept, kCreepTolerance);
}

INSTANTIATE_TEST_SUITE_P(Tree, Anchored,
                         testing::Combine(testing::Values(Kind::tree),
                                          testing::Values(Kind::tree, Kind::box, Kind::plane),
                                          testing::Values(0.0, 0.2)));
INSTANTIATE_TEST_SUITE_P(OnTree, Anchored,
                         testing::Combine(testing::Values(Kind::box, Kind::gimpact), testing::Values(Kind::tree),
                                          testing::Values(0.0, 0.2)));

// Its points were made without, and are not to stay as they were then.
TEST(AnchoredLate, HoldsWhatIsPutOnTop) {
  for (const Kind ground : {Kind::tree, Kind::box, Kind::plane}) {
    BulletWorld<> w;
    btRigidBody& below = w.add(shapeOf(ground, {kGround, kGround, 1}, 8), 0, btVector3(0, 0, 0));
    btRigidBody& body = w.add(shapeOf(Kind::tree, kSize, 2), 1, btVector3(0.1F, 0.1F, 0.66F));
    const auto lowest = [&] {
      btVector3 lower, upper;
      body.getCollisionShape()->getAabb(body.getWorldTransform(), lower, upper);
      return double(lower.z()) + double(bullet::kSpeculativeFraction) * length(kSize) - 0.5;
    };
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(120);
    for (btRigidBody* each : {&below, &body})
      each->setCollisionFlags(each->getCollisionFlags() | btCollisionObject::CF_HAS_FRICTION_ANCHOR);
    btRigidBody& heavy =
        w.add(std::make_shared<btBoxShape>(btVector3(0.3F, 0.15F, 0.15F)), 10, btVector3(0.25F, 0.1F, 1));
    heavy.setActivationState(DISABLE_DEACTIVATION);
    w.step(900);
    int anchored = 0;
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
      if (m.getBody0() != &below && m.getBody1() != &below) continue;
      for (int k = 0; k < m.getNumContacts(); ++k)
        anchored += (m.getContactPoint(k).m_contactPointFlags & BT_CONTACT_FLAG_FRICTION_ANCHOR) != 0;
    }
    EXPECT_EQ(anchored, 4) << "on " << int(ground);
    EXPECT_GT(lowest(), -2 * kRestTolerance) << "on " << int(ground);
  }
}

// The impulse that a game reads as the force between bodies.
TEST(AnchoredCallbacks, SeeTheImpulsesOfTheLastStep) {
  static btScalar sum;
  gContactAddedCallback = [](btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) {
    sum += point.m_appliedImpulse;
    return false;
  };
  for (const Kind ground : {Kind::tree, Kind::box, Kind::plane}) {
    BulletWorld<> w;
    btRigidBody& below = w.add(shapeOf(ground, {kGround, kGround, 1}, 8), 0, btVector3(0, 0, 0));
    btRigidBody& body = w.add(shapeOf(Kind::tree, kSize, 2), 1, btVector3(0.1F, 0.1F, 0.66F));
    for (btRigidBody* each : {&below, &body})
      each->setCollisionFlags(each->getCollisionFlags() | btCollisionObject::CF_HAS_FRICTION_ANCHOR |
                              btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(120);
    sum = 0;
    w.step();
    constexpr double kWeight = 9.81 / 60, kSettled = 0.05 * kWeight;  // the solver's ten rounds leave a few per cent
    EXPECT_NEAR(sum, kWeight, kSettled) << "on " << int(ground);
  }
  gContactAddedCallback = nullptr;
}

}  // namespace
}  // namespace cairn::test::friction_anchor_test
