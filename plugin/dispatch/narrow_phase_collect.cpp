// SPDX-License-Identifier: Zlib
// How a step begins, and what is done with a pair when Bullet asks about it.
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include <cstdio>
#include <typeinfo>

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

namespace {

bool isOwnedBy(const btCollisionObject& object, btOverlappingPairCache& pairs) {
  auto* ghost = dynamic_cast<const btPairCachingGhostObject*>(&object);
  return ghost && const_cast<btPairCachingGhostObject*>(ghost)->getOverlappingPairCache() == &pairs;
}

// A ghost object keeps its own pairs and has them dispatched whenever a character looks around; every one of them
// contains the ghost, so the first tells.
bool isGhostCache(btOverlappingPairCache& pairs) {
  const btBroadphasePair& first = *pairs.getOverlappingPairArrayPtr();
  return isOwnedBy(*static_cast<const btCollisionObject*>(first.m_pProxy0->m_clientObject), pairs) ||
         isOwnedBy(*static_cast<const btCollisionObject*>(first.m_pProxy1->m_clientObject), pairs);
}

}  // namespace

void NarrowPhase::Impl::beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info) {
  isCollecting_ = isWorlds(pairs);
  if (!isCollecting_) return;
  if (registration_) registration_->renew();
  stepBegan_ = ThreadCpuClock::now();
  began_ = Budget::Clock::now();
  StepBudget planned = stepLimit();
  if (planned.microseconds) *planned.microseconds = overrun_.plannable(*planned.microseconds);
  planned_ = planned.microseconds;
  left_ = budgetOf(planned);
  takeTime(info);
  collected_.clear();
  scheduled_.clear();
  asked_.resize(static_cast<std::size_t>(pairs.getNumOverlappingPairs()));
  askedUntil_ = 0;
}

// Where Bullet is not to look ahead, its broad phase does not either.
void NarrowPhase::Impl::takeTime(const btDispatcherInfo& info) {
  timeStep_ = info.m_timeStep;
  sweptTime_ = info.m_useContinuous ? info.m_timeStep : btScalar(0);
}

// A cache without pairs does not say whose it is: it counts as the world's if it had the world's pairs before.
bool NarrowPhase::Impl::isWorlds(btOverlappingPairCache& pairs) {
  if (pairs.getNumOverlappingPairs() == 0) return !worldPairs_ || worldPairs_ == &pairs;
  if (isGhostCache(pairs)) return false;
  worldPairs_ = &pairs;
  return true;
}

void NarrowPhase::Impl::process(TreePair& pair, const btCollisionObjectWrapper& body0,
                                const btCollisionObjectWrapper& body1, const btDispatcherInfo& info,
                                btManifoldResult& result, bool mayDefer) {
  // A result of another class belongs to who wants its points before this returns.
  const bool isPlain = typeid(result) == typeid(btManifoldResult) && result.m_closestPointDistanceThreshold <= 0;
  const bool isOfCompound = body0.m_parent || body1.m_parent;
  if (mayDefer && isOfCompound && !isRetired_ && !pair.notes.isOfCompound) noteCompound(pair);
  if (mayDefer && isPlain && !isRetired_) {
    if (isCollecting_) fetchPairsAskedNext(pair);
    if (isCollecting_ && settleApart(pair, body0, body1, mayBeInterrupted(), outlook())) {
      ++apartPairs_;
      if (pair.is(PairStage::broken)) countBroken();
      return;
    }
    if (isCollecting_ && collect(pair, body0, body1)) return;
    if (stepEnd_ == StepEnd::open && answerInOpenStep(pair, body0, body1, info, result)) return;
  }
  answerAtOnce(pair, body0, body1, info, result);
}

// In a large heap the states of all pairs are far more than any cache holds.
void NarrowPhase::Impl::fetchPairsAskedNext(TreePair& pair) {
  constexpr std::size_t kSubjectsAhead = 8, kCopiesAhead = 4;
  const std::size_t at = askedUntil_++;
  if (at + kSubjectsAhead >= asked_.size()) return;
  // Several threads may ask: what one reads, another may have written.
  const auto asked = [&](std::size_t i) { return std::atomic_ref(asked_[i]); };
  if (const TreePair* next = asked(at + kSubjectsAhead).load(std::memory_order_relaxed))
    fetch(*next, PairPart::subject);
  if (const TreePair* next = asked(at + kCopiesAhead).load(std::memory_order_relaxed))
    fetch(*next, isPlanned() ? PairPart::need : PairPart::copies);
  asked(at).store(&pair, std::memory_order_relaxed);
}

bool NarrowPhase::Impl::collect(TreePair& pair, const btCollisionObjectWrapper& body0,
                                const btCollisionObjectWrapper& body1) {
  if (!bullet::collect(pair, body0, body1)) return false;
  // While it is in the cache.
  if (isPlanned()) survey(pair, static_cast<std::uint64_t>(usualOperations_), left_.hasDeadline());
  const std::lock_guard lock(mutex_);
  pair.notes.collectedAt = collected_.size();
  collected_.push_back(&pair);
  return true;
}

void NarrowPhase::Impl::noteCompound(TreePair& pair) {
  pair.notes.isOfCompound = true;
  const std::lock_guard lock(mutex_);
  ofCompounds_.push_back(&pair);
}

// How many were. Users' callbacks are told of contacts that end; where the end of a step is told they may remove
// bodies. What is collected in this step settles itself, or was asked about before it broke.
std::uint32_t NarrowPhase::Impl::settleLeftOvers(bool alsoCollected) {
  leftOvers_.clear();
  for (TreePair* const pair : ofCompounds_)
    if ((alsoCollected || !pair->notes.isCollected()) && isLeftOver(*pair)) leftOvers_.push_back(pair);
  std::uint32_t settled = 0;
  for (std::size_t i = 0; i < leftOvers_.size(); ++i) {
    if (!leftOvers_[i]) continue;
    forgetBroken(*leftOvers_[i]);
    ++settled;
  }
  leftOvers_.clear();
  if (settled > 0) tellOfBroken();
  return settled;
}

void NarrowPhase::Impl::countBroken() {
  ++brokenPairs_;
  tellOfBroken();
}

// Bullet's interface cannot return it.
void NarrowPhase::Impl::tellOfBroken() {
  if (hasToldOfBroken_.exchange(true)) return;
  std::fprintf(
      stderr,
      "a body's place, speed or force is no number or endless: its sphere-tree pairs have no contacts until it "
      "is one again (said once; StepStatistics::brokenPairs counts them)\n");
}

void NarrowPhase::Impl::answerAtOnce(TreePair& pair, const btCollisionObjectWrapper& body0,
                                     const btCollisionObjectWrapper& body1, const btDispatcherInfo& info,
                                     btManifoldResult& result) {
  if (settleBroken(pair, body0, body1)) return countBroken();
  Budget budget = Budget::unlimited();
  ContactScratch scratch;  // queries may come from any thread
  if (!bullet::begin(pair, body0, body1, {.timeStep = info.m_timeStep}, result.m_closestPointDistanceThreshold,
                     Remeasured::all, budget, scratch))
    return;
  pair.traversal().refine(budget);
  bullet::finish(pair, dispatcher_, result, {policy_, finest_, false}, budget, scratch);
}

}  // namespace cairn::bullet
