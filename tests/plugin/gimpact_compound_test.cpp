// SPDX-License-Identifier: Zlib
// Compounds of sphere-trees where GImpact's algorithm is registered, before the narrow phase or after it: its row of
// the dispatcher's tables is not about trees.
#include <gtest/gtest.h>

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>

#include <optional>
#include <string>
#include <utility>

#include "front_ends.h"
#include "gimpact_mesh.h"

namespace cairn::test::gimpact_compound_test {
namespace {

using Child = std::shared_ptr<btCollisionShape>;

std::shared_ptr<btCompoundShape> pairOf(const Child& left, const Child& right) {
  auto compound = std::make_shared<btCompoundShape>();
  compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(-0.35), 0, 0)), left.get());
  compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.35), 0, 0)), right.get());
  return {compound.get(), [compound, left, right](btCompoundShape*) {}};
}

Child block() {
  return std::make_shared<btBoxShape>(btVector3(btScalar(0.25), btScalar(0.2), btScalar(0.15)));
}

Child blockOfTree() {
  static const auto tree = plainTree(cuboid({0.5, 0.4, 0.3}, 4));
  return treeShape(tree);
}

struct Kind {
  const char* name;
  std::shared_ptr<btCompoundShape> (*make)();
  bool isOfTreesAlone;  // boxes in them are left to GImpact's algorithm
};
const Kind kWithTrees[] = {
    {"two trees", [] { return pairOf(blockOfTree(), blockOfTree()); }, true},
    {"nested trees", [] { return pairOf(blockOfTree(), pairOf(blockOfTree(), blockOfTree())); }, true},
    {"a tree beside a box", [] { return pairOf(block(), blockOfTree()); }, false},
    {"a tree nested among boxes", [] { return pairOf(block(), pairOf(block(), blockOfTree())); }, false}};

enum class Registered { never, first, last };

// A mesh of GImpact's below, a compound that is thrown on it.
class Scene {
 public:
  Scene(std::shared_ptr<btCompoundShape> thrown, bool isCompoundAddedFirst, Registered registered, bool onWorld)
      : compound(std::move(thrown)) {
    if (registered == Registered::first) enter();
    narrowPhase.emplace(onWorld ? bullet::install(static_cast<btCollisionWorld&>(w.world)).value()
                                : bullet::install(w.dispatcher).value());
    if (registered == Registered::last) enter();
    const btQuaternion turned(btVector3(1, btScalar(0.5), btScalar(0.2)), btScalar(0.7));
    const auto addBody = [&] { body = &w.add(compound, 1, btVector3(0, 0, btScalar(0.8)), turned); };
    if (isCompoundAddedFirst) addBody();
    ground = &w.add(gimpactMesh(cuboid({6, 6, 0.4}, 6), btScalar(0.01)), 0, btVector3(0, 0, btScalar(-0.2)));
    if (!isCompoundAddedFirst) addBody();
    body->setLinearVelocity(btVector3(btScalar(0.3), 0, -2));
  }
  ~Scene() {
    w.remove(*body);  // before what the pair may hold of the narrow phase
    narrowPhase.reset();
  }

  std::size_t contactsOfTrees(int steps) {
    std::size_t contacts = 0;
    for (int i = 0; i < steps; ++i) {
      w.step();
      contacts += narrowPhase->lastStep().contacts;
    }
    return contacts;
  }

  BulletWorld<btCollisionDispatcher> w;
  std::shared_ptr<btCompoundShape> compound;
  std::optional<bullet::NarrowPhase> narrowPhase;
  btRigidBody* ground = nullptr;
  btRigidBody* body = nullptr;

 private:
  // Into both tables: its own registration leaves closest points alone, but users may add them.
  void enter() {
    btGImpactCollisionAlgorithm::registerAlgorithm(&w.dispatcher);
    for (int type = 0; type < MAX_BROADPHASE_COLLISION_TYPES; ++type) {
      w.dispatcher.registerClosestPointsCreateFunc(GIMPACT_SHAPE_PROXYTYPE, type, &create_);
      w.dispatcher.registerClosestPointsCreateFunc(type, GIMPACT_SHAPE_PROXYTYPE, &create_);
    }
  }
  btGImpactCollisionAlgorithm::CreateFunc create_;
};

// Whether these are a tree's node and its level, or a feature of its mesh.
bool isNamed(const SphereTree& tree, int part, std::size_t index) {
  switch (static_cast<bullet::ContactPart>(part)) {
    case bullet::ContactPart::vertex:
      return index < tree.vertices().size();
    case bullet::ContactPart::face:
      return index < tree.triangles().size();
    case bullet::ContactPart::edge:
      return index < tree.surface().features.edges().size();
    default:
      return index < tree.nodeCount() && static_cast<int>(tree.level(static_cast<NodeId>(index))) == part;
  }
}

struct TreePoints final : btCollisionWorld::ContactResultCallback {
  int count = 0, ofTrees = 0;
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int partA, int indexA,
                           const btCollisionObjectWrapper* b, int partB, int indexB) override {
    ++count;
    const bool isA = bullet::asSphereTree(a->getCollisionShape()) != nullptr;
    const bullet::SphereTreeShape* const shape = bullet::asSphereTree((isA ? a : b)->getCollisionShape());
    if (!shape) return 0;
    ofTrees += isNamed(shape->tree(), isA ? partA : partB, static_cast<std::size_t>(isA ? indexA : indexB)) ? 1 : 0;
    return point.getDistance() > 1 ? 1 : 0;
  }
};

// Install on a world, which knows where steps begin; on a dispatcher only what was registered before it can be taken.
struct Entry {
  Registered registered;
  bool onWorld;
};
const Entry kEntries[] = {{Registered::first, true}, {Registered::first, false}, {Registered::last, true}};

template <class Visit>
void forEachEntry(const Visit& visit) {
  for (const Entry& entry : kEntries)
    for (const bool isCompoundAddedFirst : {true, false}) {
      SCOPED_TRACE(std::string(entry.registered == Registered::first ? "GImpact first" : "GImpact last") +
                   (entry.onWorld ? ", on the world" : ", on the dispatcher") +
                   (isCompoundAddedFirst ? ", compound first" : ""));
      visit(entry, isCompoundAddedFirst);
    }
}

TEST(GImpactAndCompounds, TreesInThemMoveAsIfItWereNotRegistered) {
  for (const Kind& kind : kWithTrees)
    forEachEntry([&](const Entry& entry, bool isCompoundAddedFirst) {
      SCOPED_TRACE(kind.name);
      Scene with(kind.make(), isCompoundAddedFirst, entry.registered, entry.onWorld);
      Scene without(kind.make(), isCompoundAddedFirst, Registered::never, entry.onWorld);
      const std::size_t contacts = with.contactsOfTrees(60);
      EXPECT_GT(contacts, 0U);
      EXPECT_GT(with.body->getWorldTransform().getOrigin().z(), 0);
      if (!kind.isOfTreesAlone) return;
      EXPECT_EQ(contacts, without.contactsOfTrees(60));
      EXPECT_EQ(with.w.stateHash(), without.w.stateHash());
    });
}

TEST(GImpactAndCompounds, QueriesNameWhatOfTheirTreesTouches) {
  for (const Kind& kind : kWithTrees)
    for (const btScalar threshold : {btScalar(0), btScalar(0.2)})
      forEachEntry([&](const Entry& entry, bool isCompoundAddedFirst) {
        SCOPED_TRACE(kind.name);
        Scene scene(kind.make(), isCompoundAddedFirst, entry.registered, entry.onWorld);
        scene.w.step();
        scene.body->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.14))));
        for (const bool isCompoundAskedFirst : {true, false}) {
          TreePoints points;
          points.m_closestDistanceThreshold = threshold;
          scene.w.world.contactPairTest(isCompoundAskedFirst ? scene.body : scene.ground,
                                        isCompoundAskedFirst ? scene.ground : scene.body, points);
          EXPECT_GT(points.ofTrees, 0) << "of " << points.count << ", threshold " << threshold;
        }
      });
}

// Bit for bit as where there is no narrow phase of ours.
TEST(GImpactAndCompounds, WithoutTreesStayGImpacts) {
  forEachEntry([&](const Entry& entry, bool isCompoundAddedFirst) {
    Scene with(pairOf(block(), pairOf(block(), block())), isCompoundAddedFirst, entry.registered, entry.onWorld);
    Scene bare(pairOf(block(), pairOf(block(), block())), isCompoundAddedFirst, Registered::first, true);
    bare.narrowPhase.reset();
    with.w.step(60);
    bare.w.step(60);
    EXPECT_GT(with.body->getWorldTransform().getOrigin().z(), 0);
    EXPECT_EQ(with.w.stateHash(), bare.w.stateHash());
  });
}

TEST(GImpactAndCompounds, TreesMayComeAndGo) {
  forEachEntry([&](const Entry& entry, bool isCompoundAddedFirst) {
    const auto inner = pairOf(block(), block());
    Scene scene(pairOf(block(), inner), isCompoundAddedFirst, entry.registered, entry.onWorld);
    scene.body->setActivationState(DISABLE_DEACTIVATION);
    const btTransform upright = scene.body->getWorldTransform();
    EXPECT_EQ(scene.contactsOfTrees(60), 0U);
    EXPECT_GT(scene.w.dispatcher.getNumManifolds(), 0);
    const auto tree = treeShape(plainTree(cuboid({0.5, 0.48, 0.38}, 4)));  // thicker than the blocks
    for (btCompoundShape* compound : {scene.compound.get(), inner.get()}) {
      scene.body->setWorldTransform(upright);
      scene.body->setLinearVelocity({0, 0, 0});
      scene.body->setAngularVelocity({0, 0, 0});
      compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 0)), tree.get());
      EXPECT_GT(scene.contactsOfTrees(30), 0U) << "was added";
      compound->removeChildShape(tree.get());
      scene.contactsOfTrees(1);
      const std::size_t contacts = scene.contactsOfTrees(20);
      // On a dispatcher, a step without trees is none, and the last one is told.
      EXPECT_EQ(entry.onWorld ? contacts : 0, 0U) << "was removed";
      EXPECT_GT(scene.w.dispatcher.getNumManifolds(), 0);
      EXPECT_GT(scene.body->getWorldTransform().getOrigin().z(), 0);
    }
  });
}

}  // namespace
}  // namespace cairn::test::gimpact_compound_test
