// SPDX-License-Identifier: Zlib
// Worlds whose pairs and islands are worked on by several threads: the same bits for any number of them.
#include <random>

#include "casts.h"
#include "collider_shapes.h"
#include "mt_world.h"

namespace cairn::test::threads_test {
namespace {

// Bodies in a pile on a floor that is a tree, with Bullet's own between them.
void fillPile(MtWorld& w) {
  w.add(treeShape(plainTree(cuboid({12, 12, 1}, 6))), 0, btVector3(0, 0, btScalar(-0.5)));
  const auto ring = treeShape(plainTree(torus(0.35, 0.12, 12)));
  const auto brick = treeShape(plainTree(cuboid({0.8, 0.4, 0.3}, 2)));
  const auto box = std::make_shared<btBoxShape>(btVector3(btScalar(0.3), btScalar(0.2), btScalar(0.2)));
  for (int i = 0; i < 60; ++i) {
    const btVector3 at(btScalar(0.7) * btScalar(i % 4), btScalar(0.7) * btScalar(i / 4 % 4),
                       btScalar(0.5) + btScalar(0.6) * btScalar(i / 16));
    std::shared_ptr<btCollisionShape> shape = ring;
    if (i % 3 == 1) shape = brick;
    if (i % 7 == 3) shape = box;
    w.add(shape, 1, at);
  }
}

// Trees on everything they can lie on, and everything that moves on a tree, each ground by itself. Every third mover
// looks ahead.
void fillWithEverything(MtWorld& w) {
  constexpr btScalar kApart = 300;  // round grounds are a hundred metres wide
  const auto treeOf = [](const Solid& solid) { return plainTree(solid); };
  const auto setDown = [&](const TriedMover& mover, const btVector3& at) {
    btRigidBody& body = w.add(mover.body.shape, 1, btTransform(mover.turned, at), mover.body.inertia);
    if (w.bodies() % 3 == 0) body.setCcdMotionThreshold(btScalar(0.02));
  };
  const std::vector<TriedMover> movers = everyMover(treeOf);
  int place = 0;
  for (const TriedGround& ground : everyGround(treeOf)) {
    const btVector3 at(kApart * btScalar(place++), 0, 0);
    w.add(ground.shape, 0, btTransform(ground.turned, at - btVector3(0, 0, ground.top)));
    const bool isTree = ground.name == "tree";
    for (std::size_t i = 0; i < movers.size(); ++i) {
      const bool hasTree = movers[i].name.find("tree") != std::string::npos;
      const btVector3 over(btScalar(1.5) * btScalar(i % 4) - 2, btScalar(1.5) * btScalar(i / 4) - 2, btScalar(0.5));
      if (hasTree || isTree) setDown(movers[i], at + over);
    }
  }
}

TEST(Threads, BulletIsThreadSafe) {
  ASSERT_NE(threadScheduler(), nullptr) << "this Bullet was built without BT_THREADSAFE";
  EXPECT_GT(threadScheduler()->getMaxNumThreads(), 1);
}

std::uint64_t hashAfter(int threads, std::optional<std::int64_t> operations, void (*fill)(MtWorld&), int steps) {
  MtWorld w(threads, operations);
  fill(w);
  w.step(steps);
  EXPECT_TRUE(w.isSane());
  EXPECT_GT(w.dispatcher().lastStep().contacts, w.bodies()) << "few touch: the test shows little";
  return w.stateHash();
}

void expectSameBits(void (*fill)(MtWorld&), int steps) {
  for (const std::optional<std::int64_t> operations :
       {std::optional<std::int64_t>(), std::optional<std::int64_t>(5000)}) {
    const std::uint64_t alone = hashAfter(1, operations, fill, steps);
    for (const int threads : {1, 2, 4})
      for (int run = 0; run < 2; ++run)
        EXPECT_EQ(hashAfter(threads, operations, fill, steps), alone)
            << threads << " threads, " << operations.value_or(-1) << " operations, run " << run;
  }
}

TEST(Threads, SameBitsForAnyNumberOfThreadsUnderABudget) {
  expectSameBits(fillPile, 120);
}

TEST(Threads, SameBitsOnEverythingATreeMeets) {
  expectSameBits(fillWithEverything, 40);
}

// Between steps bodies are removed, added, set down elsewhere, scaled and pushed.
class Changes {
 public:
  explicit Changes(std::uint32_t seed) : random_(seed) {}

  void makeOne(MtWorld& w) {
    const std::size_t any = 1 + random_() % (w.bodies() - 1);  // not the floor
    btRigidBody& body = w.body(any);
    switch (random_() % 5) {
      case 0:
        if (w.bodies() > 20) w.remove(body);
        return;
      case 1:
        w.add(treeShape(ring_, btScalar(0.5) + btScalar(part())), 1, place());
        return;
      case 2:
        body.setWorldTransform(btTransform(btQuaternion::getIdentity(), place()));
        return body.activate();
      case 3: {
        const btScalar s = btScalar(0.5) + btScalar(part());
        const bool isTree = bullet::asSphereTree(body.getCollisionShape()) != nullptr;
        if (isTree) body.getCollisionShape()->setLocalScaling(btVector3(s, s, s));
        return body.activate();
      }
      default:
        body.setLinearVelocity(btVector3(btScalar(part()), btScalar(part()), btScalar(10 * part())));
        return body.activate();
    }
  }

 private:
  double part() { return double(random_() % 1000) / 1000; }
  btVector3 place() { return {btScalar(3 * part()), btScalar(3 * part()), btScalar(0.5 + 2 * part())}; }

  std::mt19937 random_;
  std::shared_ptr<const SphereTree> ring_ = plainTree(torus(0.35, 0.12, 12));
};

std::uint64_t hashOfChanges(int threads, int steps) {
  MtWorld w(threads, 2000);
  fillPile(w);
  Changes changes(7);
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < 3; ++k) changes.makeOne(w);
    w.step();
  }
  EXPECT_TRUE(w.isSane());
  const std::uint64_t hash = w.stateHash();
  while (w.bodies() > 0) w.remove(w.body(w.bodies() - 1));
  EXPECT_EQ(w.dispatcher().getNumManifolds(), 0) << "a manifold outlived its bodies";
  return hash;
}

// Bullet's threads line up what they made of its own shapes by who made it: without an order of ours every second run
// ends otherwise.
TEST(Threads, SameBitsAndNothingLostWhenBodiesComeAndGo) {
  const std::uint64_t alone = hashOfChanges(1, 200);
  for (const int threads : {2, 4, 2, 4}) EXPECT_EQ(hashOfChanges(threads, 200), alone) << threads << " threads";
}

// The hits of rays and of sweeps of a ball, several at a time.
class CastsAtOnce final : public btIParallelForBody {
 public:
  CastsAtOnce(const btCollisionWorld& world, int count) : world_(world) {
    std::mt19937_64 engine(11);
    for (int i = 0; i < count; ++i) ways_.push_back(randomWay(engine, 3, 2));
    fractions_.resize(ways_.size());
  }
  void forLoop(int first, int end) const override {
    const btSphereShape ball(btScalar(0.1));
    for (int i = first; i < end; ++i) {
      const Way& way = ways_[std::size_t(i)];
      btCollisionWorld::ClosestRayResultCallback ray(way.from, way.to);
      world_.rayTest(way.from, way.to, ray);
      btCollisionWorld::ClosestConvexResultCallback sweep(way.from, way.to);
      const btQuaternion level = btQuaternion::getIdentity();
      world_.convexSweepTest(&ball, btTransform(level, way.from), btTransform(level, way.to), sweep);
      fractions_[std::size_t(i)] = {ray.m_closestHitFraction, sweep.m_closestHitFraction};
    }
  }
  const std::vector<std::pair<btScalar, btScalar>>& fractions() const { return fractions_; }

 private:
  const btCollisionWorld& world_;
  std::vector<Way> ways_;
  mutable std::vector<std::pair<btScalar, btScalar>> fractions_;  // each thread its own
};

TEST(Threads, RaysAndSweepsHitTheSameFromSeveralAtOnce) {
  constexpr int kCasts = 2000;
  MtWorld w(4, {});
  fillPile(w);
  w.step(30);
  CastsAtOnce alone(w.world(), kCasts), together(w.world(), kCasts);
  alone.forLoop(0, kCasts);
  btParallelFor(0, kCasts, 16, together);
  EXPECT_EQ(together.fractions(), alone.fractions());
  const auto hits = std::ranges::count_if(alone.fractions(), [](const auto& f) { return f.first < 1 && f.second < 1; });
  EXPECT_GT(hits, kCasts / 4) << "few hit: the test shows little";
}

}  // namespace
}  // namespace cairn::test::threads_test
