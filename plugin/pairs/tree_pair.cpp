// SPDX-License-Identifier: Zlib
#include "pairs/tree_pair.h"

#include <algorithm>

#include "contacts/reduction.h"

namespace cairn::bullet {

namespace {

constexpr float kBreakingFactor = 1.01F;
// How far a contact may move in a step, as a fraction of the smaller body's size, and still be the same contact.
constexpr float kInheritanceFraction = 0.02F;
// Bullet matches points closer than the breaking threshold: chosen points keep half as much again between them.
constexpr float kSeparationFactor = 1.5F;

}  // namespace

void TreePair::reset() {
  forget();
  enter(PairStage::idle);
  work.reserved = {};
  trajectory.speculative = {};
  trajectory.isFast = false;
  motion.roots.reset();
  handles.served = {};
  notes = {};
}

bool TreePair::adopt(const PairSides& sides) {
  const SphereTreeShape* const tree = sides.shape();
  const std::optional<ColliderKind> newKind = tree ? kindOf(sides.otherShape()) : std::nullopt;
  if (!newKind) {
    forget();
    return false;
  }
  if (subject.is(*tree, sides.otherShape())) return true;
  if (subject.isMoved(*tree, sides.otherShape()))
    forgetPlaces();
  else if (subject.isKnown())
    forget();  // else there is nothing to forget, and much to write
  if (*newKind != kind) {
    kind = *newKind;
    trajectory.sweep.reset();
    collider = makeCollider(kind);
  }
  subject.take(*tree, sides.otherShape());
  return true;
}

void TreePair::forget() {
  contacts.reset();
  forgetPlaces();
  trajectory.forgetAnchor();
  subject.forget();
  clearManifolds();
}

void TreePair::forgetPlaces() {
  contacts.forgetPlaces();
  forgetAges();
  collider->reset();
  work.wasDone = true;
}

void TreePair::lookAtRest() {
  if (rest == PairRest::trimmed) return;
  rest = rest == PairRest::asked ? PairRest::unasked : PairRest::trimmed;
  if (rest != PairRest::trimmed) return;
  collider->shrinkToFit();
  contacts.shrinkToFit();
}

void TreePair::forgetWaiting() {
  forgetAges();
  trajectory.forgetAnchor();
}

void TreePair::forgetAges() {
  age.isPlaced = age.isCarriedOver = false;
  age.waited = age.error = 0;
  age.moved = age.uncounted = age.unseenMotion = 0;
  work.forget();
  contacts.guards().lock(false);
  manifolds.endFallback();
  reported.wasSpeculative = reported.areGuardsLoaded = false;
}

// An impulse that stopped a body does not predict the impulse that holds it now.
void TreePair::forgetSpeculativeImpulses() {
  if (reported.wasSpeculative) manifolds.forgetImpulses();
  reported.wasSpeculative = !trajectory.speculative.empty();
}

void TreePair::lookForJump(const RelativePlacement& now, const PairSides& sides, btScalar timeStep) {
  if (age.isPlaced && motion.areSetDown(now, sides, sizes, timeStep)) {
    contacts.guards().clear();
    trajectory.forgetAnchor();
  }
  motion.seenAt = now;
}

void TreePair::clearManifolds() {
  if (!reported.mayHavePoints) return;
  reported.mayHavePoints = false;
  reported.contacts = reported.manifolds = 0;
  manifolds.clear();
}

void TreePair::countReported() {
  reported.contacts = manifolds.countPoints();
  reported.manifolds = manifolds.countFilled();
}

void TreePair::keepGuardedAwake() {
  reported.areGuardsLoaded = manifolds.areGuardsLoaded();
  if (reported.areGuardsLoaded) manifolds.stayAwake();
}

btScalar TreePair::breakingThreshold() const {
  return btScalar(sizes.maxSeparation * kBreakingFactor);
}

btPersistentManifold* TreePair::manifold(btDispatcher& dispatcher, int cluster) {
  reported.mayHavePoints = true;
  return manifolds.make(cluster, dispatcher, breakingThreshold());
}

ManifoldWriter TreePair::writerOf(btManifoldResult& result) const {
  return {result, motion.origin, treeIsBody0, kInheritanceFraction * sizes.smaller, motion.relative};
}

std::span<Contact> TreePair::choose(int manifold, std::span<Contact> members) const {
  const btPersistentManifold* const m = manifolds.at(manifold);
  const ManifoldContacts carriedOver = m ? contactsIn(*m, treeIsBody0) : ManifoldContacts();
  return chooseContacts(members, carriedOver.span(), kSeparationFactor * sizes.speculative, sizes.speculative);
}

}  // namespace cairn::bullet
