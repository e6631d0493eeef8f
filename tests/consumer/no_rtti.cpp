// SPDX-License-Identifier: Zlib
// A game compiled with neither run-time type information nor exceptions: every place where Cairn has to know the class
// of something the game made. Says what is wrong, and 1, where anything is. Usage: no_rtti TREE
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletDynamicsCommon.h>
#include <cairn/bullet/dispatcher.h>
#include <cairn/bullet/install.h>
#include <cairn/bullet/ordered_solver.h>
#include <cairn/bullet/sphere_tree_shape.h>
#include <cairn/core/tree_file.h>
#include <cairn/effects/effect_set.h>
#include <cairn/effects/rolling_resistance.h>

#include <cstdio>
#include <memory>
#include <optional>

#if defined(__cpp_rtti) || defined(__cpp_exceptions)
#error "to be compiled with -fno-rtti -fno-exceptions"
#endif

namespace {

int failures = 0;

void expect(bool isSo, const char* what) {
  if (isSo) return;
  std::fprintf(stderr, "no_rtti: %s\n", what);
  ++failures;
}

// Classes of the game's own, derived from Bullet's: no table of theirs has any type information.
struct OwnDispatcher final : btCollisionDispatcher {
  using btCollisionDispatcher::btCollisionDispatcher;
  bool needsResponse(const btCollisionObject* a, const btCollisionObject* b) override {
    return btCollisionDispatcher::needsResponse(a, b);
  }
};
struct OwnGhost final : btPairCachingGhostObject {
  int came = 0;
  void addOverlappingObjectInternal(btBroadphaseProxy* other, btBroadphaseProxy* own) override {
    ++came;
    btPairCachingGhostObject::addOverlappingObjectInternal(other, own);
  }
};
struct OwnMesh final : btBvhTriangleMeshShape {
  using btBvhTriangleMeshShape::btBvhTriangleMeshShape;
};
struct Points final : btCollisionWorld::ContactResultCallback {
  int count = 0;
  btScalar addSingleResult(btManifoldPoint&, const btCollisionObjectWrapper*, int, int, const btCollisionObjectWrapper*,
                           int, int) override {
    ++count;
    return 0;
  }
};

// A body of the tree over a ground, in a world of any kind.
template <class Dispatcher, class Solver = btSequentialImpulseConstraintSolver>
struct Game {
  explicit Game(const std::shared_ptr<const cairn::SphereTree>& tree)
      : rock(cairn::bullet::SphereTreeShape::create(tree).value()), compound(std::make_unique<btCompoundShape>()) {
    triangles.addTriangle({-50, 0, 50}, {50, 0, 50}, {50, 0, -50});
    triangles.addTriangle({-50, 0, 50}, {50, 0, -50}, {-50, 0, -50});
    level = std::make_unique<OwnMesh>(&triangles, true);
    ground.emplace(0, nullptr, level.get());
    compound->addChildShape(btTransform::getIdentity(), rock.get());
    btVector3 inertia;
    rock->calculateLocalInertia(1, inertia);
    body.emplace(1, nullptr, rock.get(), inertia);
    body->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, rock->size(), 0)));
    child.emplace(1, nullptr, compound.get(), inertia);
    child->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(3, 1, 0) * rock->size()));
    broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&ghostPairs);
    world.addRigidBody(&*ground);
    world.addRigidBody(&*body);
    world.addRigidBody(&*child);
    for (btRigidBody* each : {&*body, &*child}) each->setActivationState(DISABLE_DEACTIVATION);
  }
  ~Game() {
    for (btRigidBody* each : {&*ground, &*body, &*child}) world.removeRigidBody(each);
  }
  void fall() {
    for (int step = 0; step < 240; ++step) world.stepSimulation(btScalar(1) / 60, 0);
  }
  bool liesOnTheGround() const {
    const btScalar size = rock->size();
    for (const btRigidBody* each : {&*body, &*child}) {
      const btScalar height = each->getWorldTransform().getOrigin().y();
      if (!(height > btScalar(0.05) * size && height < size)) return false;
    }
    return true;
  }

  std::unique_ptr<cairn::bullet::SphereTreeShape> rock;
  std::unique_ptr<btCompoundShape> compound;
  btTriangleMesh triangles;
  std::unique_ptr<OwnMesh> level;
  std::optional<btRigidBody> ground, body, child;
  btGhostPairCallback ghostPairs;
  btDefaultCollisionConfiguration configuration;
  Dispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  Solver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
};

using Tree = std::shared_ptr<const cairn::SphereTree>;

void fallsAndIsAsked(const Tree& tree) {
  Game<cairn::bullet::Dispatcher<>> game(tree);
  btGImpactCollisionAlgorithm::registerAlgorithm(&game.dispatcher);
  OwnGhost ghost;
  btBoxShape region(btVector3(1, 1, 1) * game.rock->size());
  ghost.setCollisionShape(&region);
  ghost.setCollisionFlags(btCollisionObject::CF_NO_CONTACT_RESPONSE);
  game.world.addCollisionObject(&ghost, btBroadphaseProxy::SensorTrigger, btBroadphaseProxy::AllFilter);
  game.fall();
  expect(game.liesOnTheGround(), "a rock does not lie on the ground in a world of Dispatcher");
  expect(ghost.came > 0 && ghost.getNumOverlappingObjects() > 0, "a ghost of the game's own sees nobody");
  const unsigned pairs = game.dispatcher.lastStep().pairs;
  game.dispatcher.dispatchAllCollisionPairs(ghost.getOverlappingPairCache(), game.world.getDispatchInfo(),
                                            &game.dispatcher);
  expect(game.dispatcher.lastStep().pairs == pairs, "a ghost's pairs are taken for a step");

  const btVector3 over = game.body->getWorldTransform().getOrigin() + btVector3(0, 2, 0) * game.rock->size();
  const btVector3 under = over - btVector3(0, 4, 0) * game.rock->size();
  constexpr int kSolid = btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::SensorTrigger;
  btCollisionWorld::ClosestRayResultCallback ray(over, under);
  ray.m_collisionFilterMask = kSolid;
  game.world.rayTest(over, under, ray);
  expect(ray.m_collisionObject == &*game.body, "a ray does not hit the rock");
  btSphereShape ball(btScalar(0.05) * game.rock->size());
  btTransform from(btQuaternion::getIdentity(), over), to(btQuaternion::getIdentity(), under);
  btCollisionWorld::ClosestConvexResultCallback sweep(over, under);
  sweep.m_collisionFilterMask = kSolid;
  game.world.convexSweepTest(&ball, from, to, sweep);
  expect(sweep.m_hitCollisionObject == &*game.body, "a sweep does not hit the rock");
  game.rock->setCastTarget(cairn::bullet::CastTarget::spheres);
  btCollisionWorld::ClosestRayResultCallback atBalls(over, under);
  atBalls.m_collisionFilterMask = kSolid;
  game.world.rayTest(over, under, atBalls);
  expect(atBalls.hasHit() && atBalls.m_closestHitFraction != ray.m_closestHitFraction, "a ray is not told of balls");
  Points points;
  game.world.contactTest(&*game.body, points);
  expect(points.count > 0, "a contact test finds nothing");
  game.world.removeCollisionObject(&ghost);
}

void isInstalled(const Tree& tree) {
  Game<OwnDispatcher> game(tree);
  auto cairn = cairn::bullet::install(static_cast<btCollisionWorld&>(game.world));
  expect(cairn.ok(), "is not installed on a world");
  if (!cairn) return;
  expect(!cairn::bullet::install(static_cast<btCollisionWorld&>(game.world)).ok(), "is installed twice");
  game.fall();
  expect(game.liesOnTheGround(), "a rock does not lie on the ground in a world installed on");
  expect(cairn.value().lastStep().pairs >= 2, "a world installed on has no pairs of trees");
}

void isSlowedDown(const Tree& tree) {
  Game<cairn::bullet::Dispatcher<>, cairn::bullet::OrderedSolver<>> game(tree);
  auto effects = cairn::effects::EffectSet::create(game.world);
  expect(effects.ok(), "no effects in a world with an ordered solver");
  if (!effects) return;
  const cairn::effects::RollingResistance rolling(
      cairn::effects::PairTable<cairn::effects::RollingResistance::Lengths>{});
  expect(effects.value()->canAct(rolling).ok(), "an ordered solver is not known as one that can resist rolling");
  game.fall();
  expect(game.liesOnTheGround(), "a rock does not lie on the ground with effects");
}

void meetsGImpact(const Tree& tree) {
  Game<cairn::bullet::Dispatcher<>> game(tree);
  btGImpactCollisionAlgorithm::registerAlgorithm(&game.dispatcher);
  btGImpactMeshShape mesh(&game.triangles);
  mesh.setMargin(0);
  mesh.updateBound();
  game.world.removeRigidBody(&*game.ground);
  game.ground->setCollisionShape(&mesh);
  game.world.addRigidBody(&*game.ground);
  game.fall();
  expect(game.liesOnTheGround(), "a rock does not lie on a mesh of GImpact's");
  expect(game.dispatcher.lastStep().pairs >= 2, "pairs with a mesh of GImpact's are left to GImpact");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: no_rtti TREE\n"), 2;
  auto loaded = cairn::loadTree(argv[1]);
  if (!loaded) return std::fprintf(stderr, "no_rtti: %s\n", loaded.error().message.c_str()), 1;
  const auto tree = std::make_shared<const cairn::SphereTree>(std::move(loaded).value());
  fallsAndIsAsked(tree);
  isInstalled(tree);
  isSlowedDown(tree);
  meetsGImpact(tree);
  return failures == 0 ? 0 : 1;
}
