// SPDX-License-Identifier: GPL-3.0-or-later
#include "world_check.h"

#include "pair_oracle.h"
#include "world_play.h"

namespace cairn::fuzz {
namespace {

constexpr int kMaxOrders = 24;
constexpr std::size_t kMaxTrianglePairs = 4000;
constexpr int kMaxTruths = 3;  // of a play: brute force takes milliseconds
// Of a step: what one turn finds costs no more to measure (eight families of eight leaves, five operations each).
constexpr std::uint64_t kMeasured = 5;
constexpr std::uint64_t kOneTurn = 64 * kMeasured;
// Of an unresolved pair: 32 known pairs are tested again, 32 of the front and the 65 of whole bodies compared, eight
// points of it measured, and it may be held.
constexpr std::uint64_t kStandIn = 32 * 5 + 97 * 3 + 8 * 5 + 2;

bool isFinite(const btVector3& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

void requireSoundPoint(const btManifoldPoint& point) {
  require(isFinite(point.getPositionWorldOnA()) && isFinite(point.getPositionWorldOnB()) &&
              std::isfinite(point.getDistance()),
          "a contact is not finite");
  const btScalar squared = point.m_normalWorldOnB.length2();
  require(squared > btScalar(0.99) && squared < btScalar(1.01), "a contact's normal is no direction");
}

template <class World>
class Judge {
 public:
  explicit Judge(Play<World>& play) : play_(play), w_(play.w) {}

  void look() {
    const bullet::StepStatistics& s = w_.dispatcher.lastStep();
    require(
        s.worstErrorFraction >= 0 && s.meanErrorFraction >= 0 && s.meanErrorFraction <= s.worstErrorFraction * 1.000001,
        "a step's errors are negative, no numbers, or their mean beyond their worst");
    if (play_.state.isHonest) require(std::isfinite(s.worstErrorFraction), "a step's error is not finite");
    requireBodies();
    requireContacts();
    requireOperations(s);
    requireTruth(s);
    play_.state.isFirstStep = false;
  }

 private:
  bool mayBeNone(const btCollisionObject* object) const {
    return std::ranges::any_of(play_.actors, [&](const Actor& a) { return a.body == object && a.isBroken; });
  }

  void requireBodies() {
    if (!play_.state.isHonest) return;
    for (const Actor& actor : play_.actors) {
      // A static body's speed may have been made one, and stays it.
      const btVector3& place = actor.body->getWorldTransform().getOrigin();
      const bool isNumber =
          actor.body->isStaticObject() ? std::isfinite(place.x() + place.y() + place.z()) : test::isSane(*actor.body);
      require(actor.isBroken || isNumber, "a body became no number that was not made none");
    }
  }

  void requireContacts() {
    const btCollisionObjectArray& objects = w_.world.getCollisionObjectArray();
    for (int i = 0; i < w_.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w_.dispatcher.getManifoldByIndexInternal(i);
      bool isSound = play_.state.isHonest;
      for (const btCollisionObject* body : {m.getBody0(), m.getBody1()}) {
        require(objects.findLinearSearch(const_cast<btCollisionObject*>(body)) < objects.size(),
                "a manifold outlived a body");
        isSound = isSound && !mayBeNone(body);
      }
      for (int k = 0; isSound && k < m.getNumContacts(); ++k) requireSoundPoint(m.getContactPoint(k));
    }
  }

  /// Of a step between trees and planes: see docs/algorithms/narrow-phase.md. Where answers are kept from earlier
  /// steps they may measure anew all they have, but no more. What looks ahead may go on beyond any budget.
  void requireOperations(const bullet::StepStatistics& s) {
    const PlayState& state = play_.state;
    const bool knowsSteps = !std::is_same_v<decltype(w_.dispatcher), test::InstalledOnDispatcher>;
    if (!knowsSteps || !state.budget.operations || state.isTimed) return;
    std::uint64_t most = std::uint64_t(*state.budget.operations) + kOneTurn + s.unresolvedPairs * kStandIn;
    for (std::size_t i = 0; i < play_.actors.size(); ++i) {
      const Actor& a = play_.actors[i];
      if (!a.made.tree && a.made.shape->getShapeType() != STATIC_PLANE_PROXYTYPE) return;
      if (a.body->getCcdMotionThreshold() > 0) return;
      for (std::size_t j = 0; j < i; ++j) most += mostBeyond(a, play_.actors[j]);
    }
    require(s.operations <= most, "a step cost more than its budget and what stands in for answers");
  }

  /// The cost that a pair may have beyond its share of the budget.
  std::uint64_t mostBeyond(const Actor& a, const Actor& b) const {
    if (!a.made.tree && !b.made.tree) return 0;
    // Few triangles that answer for their leaf pairs cost two each and one a pair; against planes, two a corner.
    const std::uint64_t trianglesA = trianglesOf(a), trianglesB = trianglesOf(b);
    const std::uint64_t few = 2 * (trianglesA + trianglesB) + trianglesA * trianglesB;
    return few + (play_.state.isFirstStep ? 0 : kMeasured * leavesOf(a) * leavesOf(b));
  }

  static std::uint64_t trianglesOf(const Actor& actor) {
    return actor.made.tree ? actor.made.tree->tree().triangles().size() : 1;
  }
  static std::uint64_t leavesOf(const Actor& actor) {
    return actor.made.tree ? actor.made.tree->tree().leafCount() : 1;
  }

  const bullet::SphereTreeShape* plainTree(const Actor& actor) const {
    return actor.made.tree && actor.made.isHonest && !actor.isBroken && actor.made.tree->getMargin() == 0
               ? actor.made.tree
               : nullptr;
  }

  int contactsOf(const Actor& a, const Actor& b) const {
    int contacts = 0;
    for (int i = 0; i < w_.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w_.dispatcher.getManifoldByIndexInternal(i);
      const bool isTheirs =
          (m.getBody0() == a.body && m.getBody1() == b.body) || (m.getBody0() == b.body && m.getBody1() == a.body);
      if (isTheirs) contacts += m.getNumContacts();
    }
    return contacts;
  }

  void requireTruth(const bullet::StepStatistics& s) {
    for (std::size_t i = 0; i < play_.actors.size(); ++i)
      for (std::size_t j = 0; j < i && truths_ < kMaxTruths; ++j) requireTruthOf(s, play_.actors[i], play_.actors[j]);
  }

  void requireTruthOf(const bullet::StepStatistics& s, const Actor& a, const Actor& b) {
    const bullet::SphereTreeShape *shapeA = plainTree(a), *shapeB = plainTree(b);
    if (!shapeA || !shapeB || !(a.body->isActive() || b.body->isActive())) return;  // else Bullet does not ask
    if (shapeA->tree().triangles().size() * shapeB->tree().triangles().size() > kMaxTrianglePairs) return;
    const TreeBody bodyA{shapeA, a.body->getWorldTransform()}, bodyB{shapeB, b.body->getWorldTransform()};
    const double sizes = double(shapeA->size()) + double(shapeB->size());
    const double size = std::min(double(shapeA->size()), double(shapeB->size()));
    // Where bodies stand is known to a unit of their place and size alone.
    const double place = double(bodyA.pose.getOrigin().length() + bodyB.pose.getOrigin().length());
    const double slack = 2 * double(kOverlapSlack) * sizes + 8 * double(SIMD_EPSILON) * place +
                         double(bullet::kSpeculativeFraction) * size;
    const double certified = double(shapeA->scale()) * double(shapeA->tree().levelError(kMaxDepth)) +
                             double(shapeB->scale()) * double(shapeB->tree().levelError(kMaxDepth));
    if (contactsOf(a, b) > 0) {
      ++truths_;
      // Of several pairs the step tells the worst; what no budget has ever stopped is no worse than its leaves.
      const double told = s.worstErrorFraction * size * (1 + 1e-6);
      require(areWithin(bodyA, bodyB, (play_.state.wasLimited ? told : std::min(told, certified)) + slack),
              "bodies have contacts though farther apart than the step certifies");
    } else if (s.unresolvedPairs == 0 && !play_.state.wasLimited && areBoxesNear(a, b)) {
      ++truths_;
      require(depthWhereTheyCross(bodyA, bodyB) <= certified + slack,
              "bodies are deeper in each other than certified and have no contact");
    }
  }

  static bool areBoxesNear(const Actor& a, const Actor& b) {
    btVector3 lowerA, upperA, lowerB, upperB;
    a.body->getAabb(lowerA, upperA);
    b.body->getAabb(lowerB, upperB);
    return TestAabbAgainstAabb2(lowerA, upperA, lowerB, upperB);
  }

  Play<World>& play_;
  World& w_;
  int truths_ = 0;
};

struct Ending {
  std::uint64_t hash = 0;
  bool isTimed = false;
};

template <class World>
std::uint64_t stateOf(const World& w) {
  StateHash hash;
  hash.add(w.stateHash());
  for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *const_cast<World&>(w).dispatcher.getManifoldByIndexInternal(i);
    for (int k = 0; k < m.getNumContacts(); ++k) {
      hash.add(m.getContactPoint(k).getDistance());
      for (int axis = 0; axis < 3; ++axis) hash.add(m.getContactPoint(k).getPositionWorldOnB()[axis]);
    }
  }
  hash.add(w.dispatcher.lastStep().operations);
  return hash.value();
}

template <class World>
Ending endOf(World& w, Bytes& bytes) {
  Play<World> play(w, bytes);
  Judge<World> judge(play);
  for (int i = 0; i < kMaxOrders && (i == 0 || !bytes.done()); ++i) {
    play.step();
    judge.look();
    for (std::uint32_t orders = bytes.below(3); orders > 0; --orders) play.order();
  }
  const Ending ending{stateOf(w), play.state.isTimed};
  for (const Actor& actor : play.actors) w.remove(*actor.body);
  w.step();  // lets go of what Bullet's own world predicted of fast convex bodies, which it keeps for a step
  require(w.dispatcher.getNumManifolds() == 0, "a manifold outlived all bodies");
  return ending;
}

Ending played(test::FrontEnd frontEnd, Bytes bytes) {
  Ending ending;
  test::inWorldOf(frontEnd, [&](auto& world) { ending = endOf(world, bytes); });
  return ending;
}

}  // namespace

void checkWorld(Bytes bytes) {
  const test::FrontEnd frontEnd = test::kEveryFrontEnd[bytes.below(3)];
  const bool isTwice = bytes.below(4) == 0;
  const Ending ending = played(frontEnd, bytes);
  if (isTwice && !ending.isTimed)
    require(played(frontEnd, bytes).hash == ending.hash, "the same world ended in other bits");
}

}  // namespace cairn::fuzz
