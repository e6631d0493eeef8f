// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "cairn/bullet/step_frame.h"
#include "installed_dispatchers.h"
#include "priorities.h"
#include "require.h"
#include "shapes_from_bytes.h"

namespace cairn::fuzz {

/// A body of the play, and what may be asked about it.
struct Actor {
  btRigidBody* body = nullptr;
  MadeShape made;
  bool isBroken = false;  ///< was made no number
  bool isPredicted =
      false;  ///< Bullet itself looks ahead for it, and makes contacts with whatever it finds, broken or not
};

/// The calls to the narrow phase, and the play as a whole.
struct PlayState {
  bullet::StepBudget budget, frame;
  bool moves = false;       ///< bodies move by themselves; else they are where they were set down
  bool isTimed = false;     ///< a budget of microseconds was set once: bits differ
  bool wasLimited = false;  ///< a budget was set once
  bool isHonest = true;     ///< no damaged tree took part
  bool isFirstStep = true;  ///< nothing is kept of earlier steps
  int mostPowerOfTen = 1;
  btVector3 origin{0, 0, 0};  ///< about which bodies are set down
};

/// Does to a world what the bytes say, one order after the other.
template <class World>
class Play {
 public:
  Play(World& world, Bytes& bytes) : w(world), bytes_(bytes) {
    state.moves = bytes.below(2) == 0;
    state.mostPowerOfTen = state.moves ? 1 : 4;
    const btScalar away = btScalar(bytes.below(3) == 1 ? std::pow(10.0, bytes.below(6)) : 0.0);
    state.origin = btVector3(away, -away, away / 2);
    if (!state.moves) w.world.setGravity(btVector3(0, 0, 0));
    limit();
    for (std::uint32_t i = 2 + bytes.below(6); i > 0; --i) add();
  }

  void order() {
    switch (bytes_.below(12)) {
      case 0:
        return add();
      case 1:
        return remove();
      case 2:
        return teleport();
      case 3:
        return scale();
      case 4:
        return limit();
      case 5:
        return choosePolicy();
      case 6:
        return clean();
      case 7:
        return push();
      case 8:
        return replaceTree();
      case 9:
        return harm();
      default:
        return;
    }
  }

  void step() {
    if (state.moves) {
      if (bytes_.below(4) == 1)
        bullet::stepFrame(w.world, w.dispatcher, btScalar(1.0 / 30), 3, btScalar(1.0 / 60));
      else
        w.step();
      state.isFirstStep = false;
    }
    w.world.performDiscreteCollisionDetection();
  }

  World& w;
  PlayState state;
  std::vector<Actor> actors;

 private:
  static constexpr std::size_t kMaxBodies = 10;
  static constexpr int kTrees = 1, kOthers = 2;  // what is no tree meets trees alone: Bullet answers for the rest

  Actor* any() { return actors.empty() ? nullptr : &actors[bytes_.below(std::uint32_t(actors.size()))]; }

  bool anyIs(bool Actor::*what) const { return std::ranges::any_of(actors, what); }

  btTransform placeFrom() {
    const Actor* const other = any();
    const auto size = btScalar(other && other->made.tree ? other->made.tree->size() : btScalar(1));
    const auto coordinate = [&] { return size * btScalar(bytes_.between(-1, 1)); };
    const btQuaternion turn{btScalar(bytes_.between(-1, 1)), btScalar(bytes_.between(-1, 1)),
                            btScalar(bytes_.between(-1, 1)), btScalar(1.1)};
    switch (bytes_.below(4)) {
      case 0:  // the very same place
        return other && !other->isBroken ? other->body->getWorldTransform() : btTransform(turn, state.origin);
      case 1: {  // one in the other, as it lies
        btTransform at = other && !other->isBroken ? other->body->getWorldTransform() : btTransform(turn, state.origin);
        at.getOrigin() += btVector3(coordinate(), 0, 0);
        return at;
      }
      case 2:
        return btTransform(btQuaternion::getIdentity(),
                           state.origin + btVector3{coordinate(), coordinate(), coordinate()});
      default:
        return btTransform(turn.normalized(), state.origin + btVector3{coordinate(), coordinate(), coordinate()});
    }
  }

  void add() {
    if (actors.size() >= kMaxBodies) return;
    Actor actor;
    actor.made = shapeFrom(bytes_, state.mostPowerOfTen, bytes_.below(4) == 1);
    const bool isFixed = actor.made.isFixed || bytes_.below(4) == 1;
    const btTransform at = placeFrom();
    btVector3 inertia(0, 0, 0);
    const btScalar mass = isFixed ? btScalar(0) : btScalar(bytes_.between(0.5, 2));
    if (mass > 0) actor.made.shape->calculateLocalInertia(mass, inertia);
    actor.body = &w.add(actor.made.shape, mass, at.getOrigin(), at.getRotation());
    w.world.removeRigidBody(actor.body);
    w.world.addRigidBody(actor.body, actor.made.hasTree ? kTrees : kOthers, actor.made.hasTree ? -1 : kTrees);
    if (bytes_.below(2) == 0) actor.body->setActivationState(DISABLE_DEACTIVATION);
    const bool looksAhead = state.moves && bytes_.below(8) == 1;
    if (looksAhead && (actor.made.hasTree || !anyIs(&Actor::isBroken))) {
      actor.body->setCcdMotionThreshold(btScalar(0.1));
      actor.isPredicted = !actor.made.hasTree;
    }
    state.isHonest = state.isHonest && actor.made.isHonest;
    actors.push_back(std::move(actor));
  }

  void remove() {
    Actor* const actor = any();
    if (!actor) return;
    kept_.push_back(actor->made.shape);
    w.remove(*actor->body);
    actors.erase(actors.begin() + (actor - actors.data()));
  }

  void teleport() {
    Actor* const actor = any();
    if (!actor) return;
    const btTransform at = placeFrom();
    actor->body->setWorldTransform(at);
    actor->body->setInterpolationWorldTransform(at);
    w.world.updateSingleAabb(actor->body);
  }

  void scale() {
    Actor* const actor = any();
    if (!actor || !actor->made.tree) return;
    const auto s = btScalar(scaleFrom(bytes_, state.mostPowerOfTen));
    actor->made.tree->setLocalScaling(btVector3(s, s, s));
    w.world.updateSingleAabb(actor->body);
  }

  bullet::StepBudget budgetFrom() {
    bullet::StepBudget budget;
    constexpr std::int64_t kFew[] = {0, 1, 10, 100};
    switch (bytes_.below(6)) {
      case 0:
      case 1:
        break;
      case 2:
        budget.operations = kFew[bytes_.below(4)];
        break;
      case 3:
        budget.microseconds = double(bytes_.below(3)) * 20;
        state.isTimed = true;
        break;
      default:
        budget.operations = bytes_.below(5000);
    }
    state.wasLimited = state.wasLimited || budget.operations || budget.microseconds;
    return budget;
  }

  void limit() {
    if (bytes_.below(4) == 1) {
      state.frame = budgetFrom();
      require(w.dispatcher.setFrameBudget(state.frame).ok(), "a frame's budget was refused");
      return;
    }
    state.budget = budgetFrom();
    require(w.dispatcher.setBudget(state.budget).ok(), "a budget was refused");
  }

  void choosePolicy() {
    using bullet::Unresolved;
    constexpr Unresolved kPolicies[] = {Unresolved::guard, Unresolved::repel, Unresolved::ignore,
                                        Unresolved::compensate};
    w.dispatcher.setUnresolved(kPolicies[bytes_.below(4)]);
    w.dispatcher.setFinest(bytes_.below(2) == 0 ? bullet::Finest::leaves : bullet::Finest::triangles);
    w.dispatcher.setPriority(test::makePriority(test::kPriorities[bytes_.below(4)]));
  }

  void clean() {
    if (Actor* const actor = any())
      w.world.getBroadphase()->getOverlappingPairCache()->cleanProxyFromPairs(actor->body->getBroadphaseHandle(),
                                                                              &w.dispatcher);
  }

  void push() {
    Actor* const actor = any();
    if (!actor || actor->isBroken) return;
    const auto part = [&] { return btScalar(20 * bytes_.between(-1, 1)); };
    actor->body->setLinearVelocity(btVector3{part(), part(), part()});
    actor->body->setAngularVelocity(btVector3{part(), part(), part()});
    actor->body->activate();
  }

  void replaceTree() {
    Actor* const actor = any();
    if (!actor || !actor->made.tree) return;
    MadeShape next = treeShapeFrom(bytes_, state.mostPowerOfTen, bytes_.below(4) == 1);
    state.isHonest = state.isHonest && next.isHonest;
    kept_.push_back(std::exchange(actor->made, std::move(next)).shape);
    actor->body->setCollisionShape(actor->made.shape.get());
    w.world.updateSingleAabb(actor->body);
  }

  void harm() {
    Actor* const actor = any();
    if (!actor || bytes_.below(4) != 1 || anyIs(&Actor::isPredicted)) return;
    constexpr btScalar kNan = std::numeric_limits<btScalar>::quiet_NaN(),
                       kEndless = std::numeric_limits<btScalar>::infinity();
    // Of a static body Bullet looks at the place alone.
    const bool isStatic = actor->body->isStaticObject();
    actor->isBroken = actor->isBroken || !isStatic;
    btTransform at = actor->body->getWorldTransform();
    switch (bytes_.below(2) + (isStatic ? 2 : 2 * bytes_.below(2))) {
      case 0:
        at.setOrigin(btVector3(0, kNan, 0));
        return actor->body->setWorldTransform(at);
      case 1:
        at.getBasis()[1].setX(kNan);
        return actor->body->setWorldTransform(at);
      case 2:
        return actor->body->setLinearVelocity(btVector3(0, 0, kEndless));
      default:
        return actor->body->applyTorque(btVector3(kNan, 0, 0));
    }
  }

  Bytes& bytes_;
  std::vector<std::shared_ptr<btCollisionShape>> kept_;  // outlive what Bullet remembers of them
};

}  // namespace cairn::fuzz
