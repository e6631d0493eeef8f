// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes that lie in a smooth flat floor already, set down or pressed into it, continuous collision on: the floor's
// inner edges are no obstacles, and what swings up out of it is not pushed back. Nothing there can change a sideways
// speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "builder_meshes.h"
#include "bullet_world.h"
#include "cairn/builder/build.h"
#include "test_solids.h"

namespace cairn::test::set_down_test {
namespace {

constexpr std::uint32_t kSeed = 20053;
constexpr int kCount = 40;
constexpr double kThickness = 0.5;

const Solid& box() {
  static const Solid solid = cuboid({1, 0.7, 0.5}, 4);
  return solid;
}
Solid plate() {
  return cuboid({24, 12, kThickness}, 16);
}

std::shared_ptr<btCollisionShape> treeOf(const Solid& solid) {
  Result<SphereTree> built = builder::buildTree(meshOf(solid), builder::BuildOptions());
  if (!built) throw std::runtime_error(built.error().message);
  return treeShape(std::make_shared<const SphereTree>(std::move(built).value()));
}

// Of Bullet's, with its triangles.
struct MeshShape {
  btTriangleMesh triangles;
  std::shared_ptr<btCollisionShape> shape;

  explicit MeshShape(const Solid& solid) {
    const auto corner = [&](std::uint32_t i) {
      const Vec3d& v = solid.vertices[i];
      return btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z));
    };
    for (const auto& t : solid.triangles) triangles.addTriangle(corner(t[0]), corner(t[1]), corner(t[2]));
    shape = std::make_shared<btBvhTriangleMeshShape>(&triangles, true);
  }
};

struct Kept {
  double speed = 0, energy = 0;  // means, parts of what they had
  double mostEnergy = 0;
};

double energyOf(const btRigidBody& body) {
  const btVector3 spin = body.getAngularVelocity() * body.getWorldTransform().getBasis();
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  double energy = body.getLinearVelocity().length2();
  for (int i = 0; i < 3; ++i) energy += spin[i] * spin[i] / inverse[i];
  return energy;
}

void add(Kept& kept, const btRigidBody& body, double speed, double energy) {
  kept.speed += body.getLinearVelocity().x() / speed / kCount;
  kept.energy += energyOf(body) / energy / kCount;
  kept.mostEnergy = std::max(kept.mostEnergy, energyOf(body) / energy);
}

// Turned at random, the lowest corner so far below the floor, at 8 m/s sideways and 6 down.
Kept setDown(const std::shared_ptr<btCollisionShape>& ground, double dip, btScalar restitution) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const std::shared_ptr<btCollisionShape> shape = treeOf(box());
  Kept kept;
  for (int i = 0; i < kCount; ++i) {
    BulletWorld<> w;
    w.world.setGravity(btVector3(0, 0, 0));
    w.add(ground, 0, btVector3(0, 0, -btScalar(kThickness) / 2)).setRestitution(1);
    const float a = unit(random), b = unit(random), c = unit(random), d = unit(random);
    const btQuaternion turn = btQuaternion(a, b, c, d).normalized();
    btScalar lowest = 0;
    for (const Vec3d& v : box().vertices)
      lowest = std::min(lowest, quatRotate(turn, btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z))).z());
    btRigidBody& body = w.add(shape, 1, btVector3(0, 0, -lowest - btScalar(dip)), turn);
    body.setFriction(0);
    body.setRestitution(restitution);
    body.setLinearVelocity(btVector3(8, 0, -6));
    body.setCcdMotionThreshold(btScalar(0.1));
    const double energy = energyOf(body);
    w.step(12);
    add(kept, body, 8, energy);
  }
  return kept;
}

// At rest on the floor, then struck sideways, down and into a spin.
Kept kick(const std::shared_ptr<btCollisionShape>& ground) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const std::shared_ptr<btCollisionShape> shape = treeOf(box());
  Kept kept;
  for (int i = 0; i < kCount; ++i) {
    BulletWorld<> w;
    w.add(ground, 0, btVector3(8, 0, -btScalar(kThickness) / 2)).setFriction(0);
    btRigidBody& body = w.add(shape, 1, btVector3(0, 0, 0.25F), btQuaternion(btVector3(0, 0, 1), 3 * unit(random)));
    body.setFriction(0);
    body.setCcdMotionThreshold(btScalar(0.1));
    w.step(60);
    body.activate(true);
    const float a = unit(random), b = unit(random), c = unit(random);
    body.setLinearVelocity(btVector3(20, 0, -2));
    body.setAngularVelocity(btVector3(a, b, c) * 15);
    const double energy = energyOf(body);
    w.step(30);
    add(kept, body, 20, energy);
  }
  return kept;
}

// 0.31 and 2.2 times the energy before floors were known that a body lies in.
TEST(SetDown, InAFloorSlidesOnAndGainsNothing) {
  const MeshShape mesh(plate());
  for (const double dip : {0.01, 0.05, 0.15})
    for (const btScalar restitution : {btScalar(0), btScalar(1)}) {
      const Kept kept = setDown(mesh.shape, dip, restitution);
      std::cout << "boxes " << dip << " m in a mesh, restitution " << restitution << ": keep " << kept.speed
                << " of their speed, " << kept.energy << " of their energy, at most " << kept.mostEnergy << "\n";
      EXPECT_GT(kept.speed, 0.95) << "seed " << kSeed;
      EXPECT_LT(kept.mostEnergy, 1.1) << "seed " << kSeed;
    }
}

TEST(SetDown, KickedSlidesOn) {
  const MeshShape mesh(plate());
  const Kept onMesh = kick(mesh.shape), onTree = kick(treeOf(plate()));
  std::cout << "kicked boxes keep " << onMesh.speed << " of their speed on a mesh, " << onTree.speed << " on a tree\n";
  EXPECT_GT(onMesh.speed, 0.92) << "seed " << kSeed;
  EXPECT_GT(onTree.speed, 0.85) << "seed " << kSeed;
}

}  // namespace
}  // namespace cairn::test::set_down_test
