// SPDX-License-Identifier: Zlib
#include "pairs/tree_pair.h"

#include <algorithm>

#include "contacts/reduction.h"

namespace cairn::bullet {

namespace {

constexpr float kBreakingFactor = 1.01F;
// How far a contact may wander in a step, as a fraction of the smaller body's size, and still be the same one.
constexpr float kInheritanceFraction = 0.02F;
// Bullet matches points closer than the breaking threshold: chosen points keep half as much again between them.
constexpr float kSeparationFactor = 1.5F;

}  // namespace

void TreePair::reset() {
  forget();
  enter(PairStage::idle);
  work.promised = {};
  course.ahead = {};
  course.isFast = false;
  motion.roots.reset();
  notes = {};
}

bool TreePair::adopt(const PairSides& sides) {
  const SphereTreeShape* const tree = sides.shape();
  const std::optional<CounterpartKind> newKind = tree ? kindOf(sides.otherShape()) : std::nullopt;
  if (!newKind) {
    forget();
    return false;
  }
  if (subject.is(*tree, sides.otherShape())) return true;
  if (subject.isKnown()) forget();  // else there is nothing to forget, and much to write
  if (*newKind != kind) {
    kind = *newKind;
    course.sweep.reset();
    counterpart = makeCounterpart(kind);
  }
  subject.take(*tree, sides.otherShape());
  return true;
}

void TreePair::forget() {
  contacts.reset();
  forgetWaiting();
  counterpart->reset();
  work.wasDone = true;
  subject.forget();
  clearManifolds();
}

void TreePair::lookAtRest() {
  if (rest == PairRest::fitted) return;
  rest = rest == PairRest::asked ? PairRest::silent : PairRest::fitted;
  if (rest != PairRest::fitted) return;
  counterpart->shrinkToFit();
  contacts.shrinkToFit();
}

void TreePair::forgetWaiting() {
  age.isPlaced = age.isHeld = false;
  age.waited = age.error = 0;
  age.moved = age.untold = age.unseenWay = 0;
  work.forget();
  manifolds.endStandIn();
  said.wasAhead = said.areGuardsLoaded = false;
  course.forgetAnchor();
}

// What stopped a body is no guess at what holds it now.
void TreePair::forgetImpulsesAhead() {
  if (said.wasAhead) manifolds.forgetImpulses();
  said.wasAhead = !course.ahead.empty();
}

void TreePair::lookForJump(const RelativePlacement& now, const PairSides& sides, btScalar timeStep) {
  if (age.isPlaced && motion.areSetDown(now, sides, sizes, timeStep)) {
    contacts.guards().clear();
    course.forgetAnchor();
  }
  motion.seenAt = now;
}

void TreePair::clearManifolds() {
  if (!said.mayHavePoints) return;
  said.mayHavePoints = false;
  said.contacts = said.manifolds = 0;
  manifolds.clear();
}

void TreePair::countSaid() {
  said.contacts = manifolds.countPoints();
  said.manifolds = manifolds.countFilled();
}

void TreePair::holdGuards() {
  said.areGuardsLoaded = manifolds.areGuardsLoaded();
  if (said.areGuardsLoaded) manifolds.stayAwake();
}

btScalar TreePair::breakingThreshold() const {
  return btScalar(sizes.reach * kBreakingFactor);
}

btPersistentManifold* TreePair::manifold(btDispatcher& dispatcher, int cluster) {
  said.mayHavePoints = true;
  return manifolds.make(cluster, dispatcher, breakingThreshold());
}

ManifoldWriter TreePair::writerOf(btManifoldResult& result) const {
  return {result, motion.origin, treeIsBody0, kInheritanceFraction * sizes.smaller, motion.relative};
}

std::span<Contact> TreePair::choose(int manifold, std::span<Contact> members) const {
  const btPersistentManifold* const m = manifolds.at(manifold);
  const HeldContacts held = m ? heldBy(*m, treeIsBody0) : HeldContacts();
  return chooseContacts(members, held.span(), kSeparationFactor * sizes.speculative, sizes.speculative);
}

}  // namespace cairn::bullet
