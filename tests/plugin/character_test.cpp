// SPDX-License-Identifier: Zlib
// btKinematicCharacterController on trees and against them, beside the same walk on Bullet's own mesh shape.
#include <gtest/gtest.h>

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>

#include <algorithm>
#include <array>
#include <vector>

#include "casts.h"
#include "front_ends.h"

namespace cairn::test::character_test {
namespace {

/// A capsule that walks, in a world that outlives it.
class Walker {
 public:
  Walker(btDiscreteDynamicsWorld& world, const btVector3& at)
      : world_(world), character_(&ghost_, &capsule_, btScalar(0.25), btVector3(0, 0, 1)) {
    world_.getBroadphase()->getOverlappingPairCache()->setInternalGhostPairCallback(&pairs_);
    ghost_.setCollisionShape(&capsule_);
    ghost_.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
    ghost_.setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
    world_.addCollisionObject(&ghost_, btBroadphaseProxy::CharacterFilter, btBroadphaseProxy::AllFilter);
    character_.setGravity(btVector3(0, 0, btScalar(-9.81)));
    world_.addAction(&character_);
  }
  ~Walker() {
    world_.removeAction(&character_);
    world_.removeCollisionObject(&ghost_);
    world_.getBroadphase()->getOverlappingPairCache()->setInternalGhostPairCallback(nullptr);
  }
  Walker(const Walker&) = delete;
  Walker& operator=(const Walker&) = delete;

  btKinematicCharacterController& character() { return character_; }
  btVector3 place() const { return ghost_.getWorldTransform().getOrigin(); }
  /// Of the capsule's lower end.
  btScalar feet() const { return place().z() - btScalar(0.7); }

 private:
  btDiscreteDynamicsWorld& world_;
  btGhostPairCallback pairs_;
  btPairCachingGhostObject ghost_;
  btCapsuleShapeZ capsule_{btScalar(0.3), btScalar(0.8)};
  btKinematicCharacterController character_;
};

// The ground: the tree, or Bullet's own shape of the same triangles.
struct Ground {
  explicit Ground(const Solid& solid) : tree(treeShape(plainTree(solid, 4))) {
    copyTriangles(*tree, mesh);
    bvh = std::make_shared<btBvhTriangleMeshShape>(&mesh, true);
  }
  std::shared_ptr<btCollisionShape> shape(bool asTree) const {
    return asTree ? std::shared_ptr<btCollisionShape>(tree) : bvh;
  }
  std::shared_ptr<bullet::SphereTreeShape> tree;
  btTriangleMesh mesh;
  std::shared_ptr<btBvhTriangleMeshShape> bvh;
};

class Character : public testing::TestWithParam<FrontEnd> {};
INSTANTIATE_TEST_SUITE_P(Each, Character, testing::ValuesIn(kEveryFrontEnd));

// Up three steps of 0.2 and against a wall; the controller may climb 0.25 at once.
TEST_P(Character, ClimbsStepsAndStopsAtAWallAsOnBulletsMeshShape) {
  const Ground floor(cuboid({8, 4, 1}, 6)), step(cuboid({4, 4, 0.2}, 4)), wall(cuboid({0.5, 4, 2}, 4));
  btVector3 end[2];
  for (const bool asTree : {false, true})
    inWorldOf(GetParam(), [&](auto& w) {
      w.add(floor.shape(asTree), 0, btVector3(0, 0, btScalar(-0.5)));
      for (int i = 0; i < 3; ++i)
        w.add(step.shape(asTree), 0, btVector3(btScalar(3 + 0.7 * i), 0, btScalar(0.1 + 0.2 * i)));
      w.add(wall.shape(asTree), 0, btVector3(btScalar(4.25), 0, 1));
      Walker walker(w.world, btVector3(-1, btScalar(0.13), btScalar(0.8)));
      walker.character().setWalkDirection(btVector3(btScalar(0.03), 0, 0));
      btScalar highest = 0;
      for (int i = 0; i < 300; ++i) {
        w.step();
        highest = std::max(highest, walker.feet());
      }
      end[asTree] = walker.place();
      EXPECT_LT(highest, 0.9) << "never up the wall; as tree: " << asTree;
    });
  std::printf("ends at %.4f %.4f on trees, %.4f %.4f on meshes\n", double(end[1].x()), double(end[1].z()),
              double(end[0].x()), double(end[0].z()));
  EXPECT_NEAR(end[1].z() - 0.7, 0.6, 0.1) << "on the third step";
  EXPECT_NEAR(end[1].x(), end[0].x(), 0.05);
  EXPECT_NEAR(end[1].z(), end[0].z(), 0.05);
}

TEST_P(Character, FallsJumpsAndLandsOnATree) {
  const Ground floor(cuboid({6, 6, 1}, 6));
  inWorldOf(GetParam(), [&](auto& w) {
    w.add(floor.shape(true), 0, btVector3(0, 0, btScalar(-0.5)));
    Walker walker(w.world, btVector3(btScalar(0.11), btScalar(0.07), 2));
    w.step(90);
    EXPECT_TRUE(walker.character().onGround());
    EXPECT_NEAR(walker.feet(), 0, 0.05);
    walker.character().jump(btVector3(0, 0, 4));
    btScalar highest = 0;
    for (int i = 0; i < 90; ++i) {
      w.step();
      highest = std::max(highest, walker.feet());
    }
    EXPECT_GT(highest, 0.5);
    EXPECT_TRUE(walker.character().onGround());
    EXPECT_NEAR(walker.feet(), 0, 0.05);
  });
}

// A block of five tonnes on a tree's floor, as a tree or as a box.
btRigidBody& addBlock(auto& w, const Ground& floor, bool asTree) {
  w.add(floor.shape(true), 0, btVector3(0, 0, btScalar(-0.5)));
  const std::shared_ptr<btCollisionShape> box =
      std::make_shared<btBoxShape>(btVector3(btScalar(0.5), 1, btScalar(0.5)));
  const std::shared_ptr<btCollisionShape> tree = treeShape(plainTree(cuboid({1, 2, 1}, 4), 4));
  return w.add(asTree ? tree : box, 5000, btVector3(2, 0, btScalar(0.5)));
}

struct Push {
  double behind = 0, pushed = 0;  // the walker, behind the block's face; the block
};

Push pushOf(FrontEnd frontEnd, const Ground& floor, bool asTree, btScalar aside) {
  Push push;
  inWorldOf(frontEnd, [&](auto& w) {
    btRigidBody& block = addBlock(w, floor, asTree);
    Walker walker(w.world, btVector3(0, aside, btScalar(0.75)));
    walker.character().setWalkDirection(btVector3(btScalar(0.03), 0, 0));
    w.step(80);
    push = {block.getWorldTransform().getOrigin().x() - 0.5 - walker.place().x(),
            block.getWorldTransform().getOrigin().x() - 2.0};
    EXPECT_TRUE(isSane(block));
  });
  return push;
}

// Movable bodies are pushed along by the contacts of the character's ghost, at the speed at which it walks or slower;
// the controller itself is stopped by it. How deep it is in the block when the steps end is chance, within 5 cm, for
// boxes of Bullet on Bullet's floor too: the median of some places says how one pushes.
TEST_P(Character, PushesATreeThatCanMoveAsABox) {
  const Ground floor(cuboid({8, 4, 1}, 6));
  double behind[2] = {}, pushed[2] = {};
  for (const bool asTree : {false, true}) {
    std::vector<double> depths, ways;
    for (int k = -3; k <= 3; ++k) {
      const Push push = pushOf(GetParam(), floor, asTree, btScalar(0.1) * btScalar(k));
      depths.push_back(push.behind);
      ways.push_back(push.pushed);
    }
    for (std::vector<double>* figures : {&depths, &ways}) std::ranges::sort(*figures);
    behind[asTree] = depths[depths.size() / 2];
    pushed[asTree] = ways[ways.size() / 2];
    std::printf("%s: pushed by %.3f, walker %.3f behind its face\n", asTree ? "tree" : "box", pushed[asTree],
                behind[asTree]);
  }
  EXPECT_GT(behind[1], behind[0] - 0.02) << "no deeper in it than in a box";
  EXPECT_NEAR(pushed[1], pushed[0], 0.05);
}

// A ghost cannot be moved: what it stands on is squeezed between it and the floor all the time, a box as well, and now
// and then slips from under it (of 40 places a tree from one, a box from seven to nine). The median says how one
// stands.
TEST_P(Character, StandsOnATreeThatCanMoveAsOnABox) {
  constexpr int kPlaces = 9;
  const Ground floor(cuboid({8, 4, 1}, 6));
  std::array<std::vector<btScalar>, 2> stood;
  std::array<int, 2> onGround{};
  for (const bool asTree : {false, true})
    for (int i = 0; i < kPlaces; ++i)
      inWorldOf(GetParam(), [&](auto& w) {
        btRigidBody& block = addBlock(w, floor, asTree);
        w.step(60);
        const btVector3 aside(btScalar(0.1) + btScalar(0.003) * btScalar(i),
                              btScalar(0.1) - btScalar(0.02) * btScalar(i), 2);
        Walker above(w.world, block.getWorldTransform().getOrigin() + aside);
        w.step(120);
        EXPECT_TRUE(isSane(block));
        onGround[asTree] += above.character().onGround();
        stood[asTree].push_back(above.feet() - block.getWorldTransform().getOrigin().z() - btScalar(0.5));
      });
  for (const int count : onGround) EXPECT_GT(count, kPlaces / 2);
  // How deep is left to the controller.
  constexpr btScalar kToleratedPenetration(0.2);  // btKinematicCharacterController's own
  for (std::vector<btScalar>& feet : stood) {
    std::ranges::sort(feet);
    std::printf("feet over its top: %.3f, from %.3f to %.3f\n", double(feet[kPlaces / 2]), double(feet.front()),
                double(feet.back()));
    EXPECT_GT(feet[kPlaces / 2], -kToleratedPenetration);
    EXPECT_LT(feet.back(), 0.02);
  }
}

}  // namespace
}  // namespace cairn::test::character_test
