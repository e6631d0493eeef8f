// SPDX-License-Identifier: Zlib
// A shape whose mesh moves: its boxes and casts are those of the mesh as it is, pairs notice, and bodies are carried.
#include <gtest/gtest.h>

#include <limits>

#include "counting_new.h"
#include "front_ends.h"
#include "moving_meshes.h"
#include "ray_hits.h"
#include "solid_oracle.h"

namespace cairn::test::moving_mesh_test {
namespace {

using bullet::SphereTreeShape;

constexpr unsigned kSeed = 31;
constexpr double kTimeStep = 1.0 / 60;
// Of the penetration that a contact has, Bullet's solver removes this part in a step.
constexpr double kErp = 0.2;

std::vector<Vec3> floats(const std::vector<Vec3d>& vertices) {
  std::vector<Vec3> out;
  for (const Vec3d& v : vertices) out.push_back(Vec3(v));
  return out;
}

void moveTo(SphereTreeShape& shape, const std::vector<Vec3d>& vertices) {
  const Status status = shape.setVertices(floats(vertices));
  if (!status) throw std::runtime_error(status.error().message);
}

// A shape made of the moved mesh as if it had always been there.
std::shared_ptr<SphereTreeShape> anew(const SphereTreeShape& moved) {
  Result<SphereTree> tree = SphereTree::create(moved.tree().data());
  if (!tree) throw std::runtime_error(tree.error().message);
  return std::shared_ptr<SphereTreeShape>(
      SphereTreeShape::create(std::make_shared<const SphereTree>(std::move(tree).value()), moved.bodyFrame(),
                              moved.scale())
          .value());
}

class EveryMotion : public testing::TestWithParam<int> {
 protected:
  MovingMesh mesh = GetParam() == 0 ? bendingBar(6) : GetParam() == 1 ? breathingBall(6) : walkingFigure(1);
  // Leaves of more triangles than a cast tests without balls.
  std::shared_ptr<SphereTreeShape> shape = treeShape(plainTree(mesh.first, 30), btScalar(1.5));
};

TEST_P(EveryMotion, HasTheBoxAndBallOfTheMeshAsItIs) {
  std::mt19937_64 random(kSeed);
  for (int step = 1; step < 20; ++step) {
    moveTo(*shape, mesh.at(0.3 * step));
    const auto fresh = anew(*shape);
    const btTransform at = randomTransform(random);
    btVector3 lower, upper, freshLower, freshUpper, center;
    btScalar radius, farthest = 0;
    shape->getAabb(at, lower, upper);
    fresh->getAabb(at, freshLower, freshUpper);
    // Within the two shapes' own tolerances, 1e-4 of the size each.
    const btScalar tolerance = btScalar(2e-4) * shape->size();
    EXPECT_NEAR((lower - freshLower).length(), 0, tolerance);
    EXPECT_NEAR((upper - freshUpper).length(), 0, tolerance);
    EXPECT_EQ(shape->size(), fresh->size());
    shape->getBoundingSphere(center, radius);
    for (const Vec3d& v : mesh.at(0.3 * step)) {
      const btVector3 p = shape->bodyFromMesh() * (toBt(v) * shape->scale());
      farthest = btMax(farthest, p.length());
      EXPECT_LE((p - center).length(), radius * btScalar(1.00001));
    }
    EXPECT_NEAR(shape->getAngularMotionDisc(), farthest, tolerance);
  }
}

TEST_P(EveryMotion, IsHitByRaysWhereItIs) {
  std::mt19937_64 random(kSeed);
  RayTotals totals;
  for (int step = 1; step < 10; ++step) {
    moveTo(*shape, mesh.at(0.6 * step));
    for (int ray = 0; ray < 60; ++ray)
      expectSameHits(*shape, randomWay(random, double(shape->size()), 1), 0, ray % 2 == 0, totals);
  }
  EXPECT_GT(totals.hits, totals.rays / 20);
}

TEST_P(EveryMotion, IsHitByRaysAtItsBallsAsAShapeMadeAnew) {
  std::mt19937_64 random(kSeed);
  shape->setCastTarget(bullet::CastTarget::spheres);
  std::size_t hits = 0;
  for (int step = 1; step < 10; ++step) {
    moveTo(*shape, mesh.at(0.6 * step));
    const auto fresh = anew(*shape);
    fresh->setCastTarget(bullet::CastTarget::spheres);
    for (int i = 0; i < 60; ++i) {
      const Way way = randomWay(random, double(shape->size()), 1);
      RayHits moved(way, 0, false), expected(way, 0, false);
      btVector3 lower = way.from, upper = way.from;
      lower.setMin(way.to);
      upper.setMax(way.to);
      shape->processAllTriangles(&moved, lower, upper);
      fresh->processAllTriangles(&expected, lower, upper);
      EXPECT_EQ(moved.hits, expected.hits);
      hits += expected.hits.size();
    }
  }
  EXPECT_GT(hits, 30U);
}

INSTANTIATE_TEST_SUITE_P(MovingMesh, EveryMotion, testing::Values(0, 1, 2));

TEST(MovingMesh, IsLeftAsItWasByWhatItCannotFollow) {
  const MovingMesh mesh = breathingBall(4);
  const auto shape = treeShape(plainTree(mesh.first));
  moveTo(*shape, mesh.at(1));
  const auto tree = shape->sharedTree();
  const SphereTreeData before = tree->data();
  std::vector<Vec3> bad = floats(mesh.at(2));
  bad[3].z = std::numeric_limits<float>::quiet_NaN();
  const Status notANumber = shape->setVertices(bad);
  ASSERT_FALSE(notANumber);
  EXPECT_NE(notANumber.error().message.find("vertex 3 is not finite"), std::string::npos);
  EXPECT_FALSE(shape->setVertices(std::span(bad).first(5)));
  std::vector<Vec3> tiny = floats(mesh.at(2));
  for (Vec3& v : tiny) v *= 1e-22F;
  EXPECT_FALSE(shape->setVertices(tiny)) << "smaller than a shape may be";
  EXPECT_EQ(shape->sharedTree(), tree);
  EXPECT_EQ(tree->data(), before);
}

TEST(MovingMesh, LeavesOtherShapesOfItsTreeAlone) {
  const MovingMesh mesh = breathingBall(4);
  const auto tree = plainTree(mesh.first);
  const auto moving = treeShape(tree), still = treeShape(tree);
  const SphereTreeData before = tree->data();
  moveTo(*moving, mesh.at(1));
  EXPECT_EQ(still->sharedTree(), tree);
  EXPECT_EQ(tree->data(), before);
  EXPECT_NE(moving->sharedTree(), tree);
}

// Some lists are made anew in each call. None has a memory for each node, triangle or part.
TEST(MovingMesh, HardlyAllocates) {
  const MovingMesh mesh = walkingFigure(1);
  const auto shape = treeShape(plainTree(mesh.first, 4));
  std::vector<std::vector<Vec3>> phases;
  for (int i = 0; i < 40; ++i) phases.push_back(floats(mesh.at(0.3 * i)));
  for (const auto& vertices : phases) ASSERT_TRUE(shape->setVertices(vertices));
  const std::size_t before = allocations();
  for (const auto& vertices : phases) ASSERT_TRUE(shape->setVertices(vertices));
  EXPECT_LE(allocations() - before, 8 * phases.size());
}

// --- pairs ---

template <class World>
btRigidBody& addKinematic(World& w, const std::shared_ptr<SphereTreeShape>& shape) {
  btRigidBody& body = w.add(shape, 0, btVector3(0, 0, 0));
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  body.setActivationState(DISABLE_DEACTIVATION);
  body.setFriction(1);
  return body;
}

// The slab from z = -0.2 to 0.2 stretched so that its top is at a height.
std::vector<Vec3d> slabUpTo(const Solid& slab, double height) {
  std::vector<Vec3d> moved = slab.vertices;
  for (Vec3d& v : moved) v.z = (v.z + 0.2) / 0.4 * (height + 0.2) - 0.2;
  return moved;
}

// A small cube above a slab that can be stretched; `height`: of the cube's middle.
template <class Dispatcher>
struct CubeOverSlab {
  BulletWorld<Dispatcher> w;
  Solid slab = cuboid({2, 2, 0.4}, 6);
  std::shared_ptr<SphereTreeShape> ground = treeShape(plainTree(slab, 4));
  btRigidBody& body;

  explicit CubeOverSlab(double height) : body(cubeAt(height)) {}
  void raiseTo(double top) { moveTo(*ground, slabUpTo(slab, top)); }
  std::size_t contacts() const { return w.dispatcher.lastStep().contacts; }
  double height() const { return double(body.getWorldTransform().getOrigin().z()); }

 private:
  btRigidBody& cubeAt(double height) {
    addKinematic(w, ground);
    return w.add(treeShape(plainTree(cuboid({0.3, 0.3, 0.3}, 2))), 1, btVector3(0, 0, btScalar(height)));
  }
};

CAIRN_FRONT_END_SUITE(SettledPair, EveryFrontEnd);

// Nothing moves but vertices: what the pair knows of poses is as it was.
TYPED_TEST(SettledPair, NoticesThatTheSurfaceLeft) {
  CubeOverSlab<TypeParam> scene(0.351);
  scene.w.step(200);
  ASSERT_NEAR(scene.height(), 0.35, 0.002) << "it lies on the slab";
  ASSERT_GT(scene.contacts(), 0U);
  scene.raiseTo(0.1);
  scene.w.step(1);
  EXPECT_EQ(scene.contacts(), 0U) << "the top is a decimetre lower";
  scene.w.step(200);
  EXPECT_NEAR(scene.height(), 0.25, 0.002) << "it fell";
}

TYPED_TEST(SettledPair, NoticesThatTheSurfaceCame) {
  CubeOverSlab<TypeParam> scene(0.38);
  scene.body.setGravity(btVector3(0, 0, 0));
  scene.w.step(100);
  ASSERT_EQ(scene.contacts(), 0U) << "three centimetres apart";
  scene.raiseTo(0.235);
  scene.w.step(1);
  EXPECT_GE(scene.contacts(), 3U) << "half a centimetre deep";
  scene.w.step(100);
  EXPECT_GT(scene.height(), 0.383) << "it was pushed up";
}

// The surface comes and goes by turns, so that trees are used again: a pair must not take one for the other.
TYPED_TEST(SettledPair, NoticesEveryStep) {
  CubeOverSlab<TypeParam> scene(0.38);
  scene.body.setGravity(btVector3(0, 0, 0));
  const btTransform place = scene.body.getWorldTransform();
  for (int step = 0; step < 60; ++step) {
    const bool touches = step % 3 == 2;
    scene.raiseTo(touches ? 0.235 : 0.2);
    scene.body.setWorldTransform(place);
    scene.body.setLinearVelocity(btVector3(0, 0, 0));
    scene.body.setAngularVelocity(btVector3(0, 0, 0));
    scene.w.step(1);
    if (touches)
      EXPECT_GE(scene.contacts(), 3U) << "step " << step;
    else
      EXPECT_EQ(scene.contacts(), 0U) << "step " << step;
  }
}

// So the solver starts from the impulses of the step before.
TYPED_TEST(SettledPair, KeepsContactsOfTheSameFeatures) {
  CubeOverSlab<TypeParam> scene(0.351);
  scene.body.setActivationState(DISABLE_DEACTIVATION);
  for (int step = 0; step < 200; ++step) {
    scene.raiseTo(0.2 - 1e-5 * step);
    scene.w.step(1);
  }
  int oldest = 0;
  for (int i = 0; i < scene.w.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *scene.w.dispatcher.getManifoldByIndexInternal(i);
    for (int k = 0; k < m.getNumContacts(); ++k) oldest = std::max(oldest, m.getContactPoint(k).getLifeTime());
  }
  EXPECT_GT(oldest, 100);
}

// Its way in a step is five times the slab's thickness. Where it sinks in a little, it is stopped again from where it
// had not.
TYPED_TEST(SettledPair, StopsAFastBodyWhereTheSurfaceIs) {
  BulletWorld<TypeParam> w;
  const Solid slab = cuboid({2, 2, 0.4}, 6);
  const auto wall = treeShape(plainTree(slab, 4));
  addKinematic(w, wall);
  btRigidBody& body = w.add(treeShape(plainTree(ball(0.1, 4))), 1, btVector3(0, 0, 3));
  body.setCcdMotionThreshold(btScalar(0.05));
  for (int step = 0; step < 200; ++step) {
    const double top = 0.2 + 0.1 * std::sin(0.05 * step);
    moveTo(*wall, slabUpTo(slab, top));
    if (step % 20 == 0) {
      body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 3)));
      body.setLinearVelocity(btVector3(0, 0, -120));
    }
    w.step(1);
    ASSERT_GT(body.getWorldTransform().getOrigin().z(), top) << "step " << step;
  }
}

// --- bodies that are carried ---

// How deep a vertex of either mesh lies in the other.
double depthOfVertices(const SphereTreeShape& a, const btTransform& placeOfA, const SphereTreeShape& b,
                       const btTransform& placeOfB) {
  const SolidOracle solid{b.tree().vertices(), b.tree().triangles()};
  const btTransform map = (placeOfB * b.bodyFromTree()).inverse() * (placeOfA * a.bodyFromTree());
  const Sphere root = b.tree().sphere(kRootNode);
  double deepest = 0;
  for (const Vec3& v : a.tree().vertices()) {
    const btVector3 moved = map * btVector3(v.x, v.y, v.z);
    const Vec3d p(moved.x(), moved.y(), moved.z());
    if (distance(p, Vec3d(root.center)) > double(root.radius) || solid.windingNumber(p) < 0.5) continue;
    deepest = std::max(deepest, solid.toSurface(p));
  }
  return deepest;
}

struct Carried {
  BulletWorld<> w;
  MovingMesh mesh;
  std::shared_ptr<SphereTreeShape> surface, load;
  btRigidBody *below, *body;
  double speed;  // of the fastest vertex, so far

  Carried(const MovingMesh& moving, const Solid& carried, const btVector3& position)
      : mesh(moving), surface(treeShape(plainTree(mesh.first, 4))), load(treeShape(plainTree(carried, 4))), speed(0) {
    below = &addKinematic(w, surface);
    body = &w.add(load, 1, position);
    body->setFriction(1);
    body->setActivationState(DISABLE_DEACTIVATION);
  }

  double depth() const {
    const btTransform &a = body->getWorldTransform(), &b = below->getWorldTransform();
    return std::max(depthOfVertices(*load, a, *surface, b), depthOfVertices(*surface, b, *load, a));
  }

  void step(double from, double to) {
    const std::vector<Vec3d> before = mesh.at(from), after = mesh.at(to);
    for (std::size_t v = 0; v < after.size(); ++v) speed = std::max(speed, distance(before[v], after[v]) / kTimeStep);
    moveTo(*surface, after);
    w.step(1);
  }

  // The surface's speed is not given to the solver. In a step the surface gains speed * dt on the body, and the solver
  // takes the part kErp of the penetration away: they balance at speed * dt / kErp. Then the surface makes its next
  // step. Bullet's few iterations leave some of what they should take.
  double allowed() const { return 1.2 * (speed * kTimeStep / kErp + speed * kTimeStep) + restTolerance(); }
  double restTolerance() const { return double(bullet::kSpeculativeFraction * load->size()); }
};

TEST(CarriedBody, RidesOnABreathingBall) {
  Carried ride(breathingBall(8), cuboid({0.4, 0.4, 0.2}, 3), btVector3(0, 0, btScalar(1.11)));
  // On top of a ball nothing holds it sideways, so rounding would decide when it falls off.
  ride.body->setLinearFactor(btVector3(0, 0, 1));
  ride.body->setAngularFactor(btScalar(0));
  double lowest = 10, highest = 0, deepest = 0;
  for (int step = 0; step < 1000; ++step) {
    ride.step(0.02 * step, 0.02 * (step + 1));
    const double z = double(ride.body->getWorldTransform().getOrigin().z());
    if (step > 100) {
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    }
    deepest = std::max(deepest, ride.depth());
    ASSERT_LE(ride.depth(), ride.allowed()) << "step " << step;
    ASSERT_GT(z, 0.6) << "it fell off at step " << step;
  }
  EXPECT_GT(highest - lowest, 0.6) << "the top moves by 0.7";
  std::printf("deepest %.4f of %.4f allowed\n", deepest, ride.allowed());
}

TEST(CarriedBody, RidesOnABendingBar) {
  Carried ride(bendingBar(8), cuboid({0.3, 0.3, 0.2}, 3), btVector3(btScalar(1.2), 0, btScalar(0.41)));
  double lowest = 10, highest = 0, deepest = 0;
  for (int step = 0; step < 1000; ++step) {
    ride.step(0.02 * step, 0.02 * (step + 1));
    const double z = double(ride.body->getWorldTransform().getOrigin().z());
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
    deepest = std::max(deepest, ride.depth());
    ASSERT_LE(ride.depth(), ride.allowed()) << "step " << step;
    ASSERT_GT(z, -0.2) << "it fell off at step " << step;
  }
  EXPECT_GT(highest - lowest, 0.3);
  std::printf("deepest %.4f of %.4f allowed\n", deepest, ride.allowed());
}

std::uint64_t hashOfARide() {
  Carried ride(breathingBall(6), cuboid({0.4, 0.4, 0.2}, 3), btVector3(btScalar(0.1), 0, btScalar(1.11)));
  StateHash hash;
  for (int step = 0; step < 200; ++step) {
    ride.step(0.03 * step, 0.03 * (step + 1));
    hash.add(ride.w.stateHash());
  }
  return hash.value();
}

TEST(CarriedBody, RidesTwiceWithTheSameBits) {
  EXPECT_EQ(hashOfARide(), hashOfARide());
}

// A figure walks on the spot beside a rock: its leg kicks the rock away, which never gets deep into the leg.
TEST(WalkingFigure, PushesARock) {
  Carried walk(walkingFigure(1), ball(0.15, 4), btVector3(btScalar(0.2), btScalar(0.5), btScalar(0.15)));
  walk.w.addGround();
  for (int step = 0; step < 300; ++step) {
    walk.step(-0.03 * step, -0.03 * (step + 1));
    ASSERT_LE(walk.depth(), walk.allowed()) << "step " << step;
  }
  EXPECT_GT(walk.body->getWorldTransform().getOrigin().y(), 0.6);
}

// What may be spent in a step is not enough for the pair, which begins anew in each: it answers all the same.
TEST(CarriedBody, RidesOnABudget) {
  Carried ride(breathingBall(8), cuboid({0.4, 0.4, 0.2}, 3), btVector3(0, 0, btScalar(1.11)));
  ASSERT_TRUE(ride.w.dispatcher.setBudget({200, {}}).ok());
  for (int step = 0; step < 600; ++step) {
    ride.step(0.02 * step, 0.02 * (step + 1));
    ASSERT_GT(ride.body->getWorldTransform().getOrigin().z(), 0.55) << "step " << step;
  }
}

}  // namespace
}  // namespace cairn::test::moving_mesh_test
