// SPDX-License-Identifier: Zlib
// How a step begins, and how a pair is processed when Bullet asks about it.
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include "dispatch/ghost_pairs.h"

#include "dispatch/narrow_phase_impl.h"
#include "pairs/pair_begin.h"
#include "pairs/pair_collect.h"
#include "pairs/pair_cull.h"
#include "pairs/pair_estimation.h"
#include "pairs/pair_finish.h"
#include "platform/virtual_table.h"

namespace cairn::bullet {

namespace {

bool isOwnedBy(const btCollisionObject& object, btOverlappingPairCache& pairs) {
  return ghostPairsOf(object) == &pairs;
}

struct PlainResult final : btManifoldResult {};
struct TakesPointsItself final : btManifoldResult {
  void addContactPoint(const btVector3&, const btVector3&, btScalar) override {}
};

// One that takes its points itself wants them before it is let go.
bool takesPointsItself(const btManifoldResult& result) {
  static const KeptFunction adding = [] {
    const PlainResult plain;
    const TakesPointsItself other;
    return KeptFunction(&plain, &other);
  }();
  return !adding.isKeptBy(&result);
}

bool isGhost(const btCollisionObject& object) {
  return (object.getInternalType() & btCollisionObject::CO_GHOST_OBJECT) != 0;
}

// A ghost object keeps its own pairs and has them dispatched whenever a character looks around. Each of them contains
// the ghost, so the first pair shows it.
bool isGhostCache(btOverlappingPairCache& pairs) {
  const btBroadphasePair& first = *pairs.getOverlappingPairArrayPtr();
  return isOwnedBy(*static_cast<const btCollisionObject*>(first.m_pProxy0->m_clientObject), pairs) ||
         isOwnedBy(*static_cast<const btCollisionObject*>(first.m_pProxy1->m_clientObject), pairs);
}

}  // namespace

void NarrowPhase::Impl::beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info) {
  if (isRetired_) return;
  isCollecting_ = isWorlds(pairs);
  if (!isCollecting_) return;
  if (registration_) registration_->renew();
  step_.left = StepRules::budgetOf(clock_.begin(step_.rules.limit()));
  takeTime(info);
  step_.pairs.clear();
  asked_.begin(static_cast<std::size_t>(pairs.getNumOverlappingPairs()));
}

// Where Bullet does not look ahead, its broad phase does not either.
void NarrowPhase::Impl::takeTime(const btDispatcherInfo& info) {
  step_.timeStep = info.m_timeStep;
  step_.sweptTime = info.m_useContinuous ? info.m_timeStep : btScalar(0);
}

// A cache without pairs does not show whose it is: it counts as the world's if it had the world's pairs before.
bool NarrowPhase::Impl::isWorlds(btOverlappingPairCache& pairs) {
  if (pairs.getNumOverlappingPairs() == 0) return !worldPairs_ || worldPairs_ == &pairs;
  if (isGhostCache(pairs)) return false;
  worldPairs_ = &pairs;
  return true;
}

void NarrowPhase::Impl::process(TreePair& pair, const btCollisionObjectWrapper& body0,
                                const btCollisionObjectWrapper& body1, const btDispatcherInfo& info,
                                btManifoldResult& result, bool mayDefer) {
  pair.rest = PairRest::asked;
  // A result of another class belongs to a caller who wants its points before this returns.
  const bool isPlain = !takesPointsItself(result) && result.m_closestPointDistanceThreshold <= 0;
  const bool isOfCompound = body0.m_parent || body1.m_parent;
  if (mayDefer && isOfCompound && !isRetired_ && !pair.notes.isOfCompound) noteCompound(pair);
  if (mayDefer && isPlain && !isRetired_) {
    if (isCollecting_) asked_.ask(pair, step_.rules.isPlanned());
    if (isCollecting_ && cullSeparated(pair, body0, body1, step_.rules.mayBeInterrupted(), step_.horizon())) {
      ++culledPairs_;
      if (pair.is(PairStage::nonFinite)) nonFinite_.count();
      return;
    }
    if (isCollecting_ && collect(pair, body0, body1)) return;
    if (step_.rules.end() == StepEnd::open && answerInOpenStep(pair, body0, body1, info, result)) return;
  }
  answerAtOnce(pair, body0, body1, info, result);
}

bool NarrowPhase::Impl::collect(TreePair& pair, const btCollisionObjectWrapper& body0,
                                const btCollisionObjectWrapper& body1) {
  if (!bullet::collect(pair, body0, body1)) return false;
  // Now, while the pair is in the cache.
  if (step_.rules.isPlanned()) estimate(pair, step_.usual(), step_.left.hasDeadline(), step_.timeStep);
  const std::lock_guard lock(mutex_);
  step_.pairs.add(pair);
  return true;
}

void NarrowPhase::Impl::noteCompound(TreePair& pair) {
  pair.notes.isOfCompound = true;
  const std::lock_guard lock(mutex_);
  nonFinite_.watch(pair);
}

// False, and nothing done, for pairs that are answered at once: pairs of ghosts, and pairs nested too deep for a copy.
bool NarrowPhase::Impl::answerInOpenStep(TreePair& pair, const btCollisionObjectWrapper& body0,
                                         const btCollisionObjectWrapper& body1, const btDispatcherInfo& info,
                                         btManifoldResult& result) {
  if (isGhost(*body0.getCollisionObject()) || isGhost(*body1.getCollisionObject())) return false;
  takeTime(info);
  isAnswering_ = true;
  const bool isAnswered = open_.answer(pair, body0, body1, result);
  endAnswering();
  return isAnswered;
}

void NarrowPhase::Impl::answerAtOnce(TreePair& pair, const btCollisionObjectWrapper& body0,
                                     const btCollisionObjectWrapper& body1, const btDispatcherInfo& info,
                                     btManifoldResult& result) {
  if (cullNonFinite(pair, body0, body1)) return nonFinite_.count();
  Budget budget = Budget::unlimited();
  ContactScratch scratch;  // queries may come from any thread
  if (!begin(pair, body0, body1, {.timeStep = info.m_timeStep}, result.m_closestPointDistanceThreshold,
             RefreshPolicy::all, budget, scratch))
    return;
  pair.traversal().refine(budget);
  finish(pair, step_.dispatcher, result, step_.rules.policyAtOnce(), budget, scratch);
}

}  // namespace cairn::bullet
