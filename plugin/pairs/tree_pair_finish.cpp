// SPDX-License-Identifier: Zlib
// From a pair's traversal to its manifolds.
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "contacts/manifold_writer.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

namespace {

// A manifold holds points up to the reach; a little more, so that rounding does not refuse one.
constexpr float kBreakingFactor = 1.01F;

bool isOfPatches(const Contact& contact) {
  return contact.isExact && contact.pair == NodePair{kRootNode, kRootNode};
}

}  // namespace

// Null only when Bullet's pool is used up and the user forbade it to grow.
btPersistentManifold* TreePair::manifold(btDispatcher& dispatcher, int cluster) {
  btPersistentManifold*& m = manifolds_[static_cast<std::size_t>(cluster)];
  if (!m) {
    m = dispatcher.getNewManifold(objects_[0], objects_[1]);
    if (m) fetchAhead(m + 1, sizeof(btPersistentManifold));  // the next, as long as Bullet's pool is in order
  }
  if (m) m->setContactBreakingThreshold(breakingThreshold());
  mayHavePoints_ = true;
  return m;
}

btScalar TreePair::breakingThreshold() const {
  return btScalar(reach_ * kBreakingFactor);
}

ManifoldWriter TreePair::writerOf(btManifoldResult& result) const {
  return {result, origin_, treeIsBody0_, kInheritanceFraction * smallerSize_, motion_};
}

TreePair::Clusters TreePair::clustersOf(ClusteredContacts& contacts) {
  Clusters clusters;
  for (std::size_t k = 0; k < clusters.size(); ++k) clusters[k] = contacts.cluster(static_cast<int>(k));
  return clusters;
}

void TreePair::writeCluster(int k, std::span<Contact> members, const AnswerPolicy& policy, btDispatcher& dispatcher,
                            btManifoldResult& result, PairReport& report) {
  const bool isHeld = manifolds_[static_cast<std::size_t>(k)] != nullptr;
  if (members.empty() && !isHeld) return;
  btPersistentManifold* const m = manifold(dispatcher, k);
  if (!m) return;
  ManifoldWriter writer = writerOf(result);
  const HeldContacts held = writer.held(*m);
  const ContactChoice choice = chooseContacts(members, held.span(), kSeparationFactor * speculative_, speculative_);
  writer.write(*m, members, choice);
  // What the solver gets: Bullet takes two that come to one place for one.
  const auto points = static_cast<std::uint32_t>(m->getNumContacts());
  std::uint32_t exact = 0;
  for (int i = 0; i < choice.count; ++i) {
    const Contact& chosen = members[static_cast<std::size_t>(choice.index[static_cast<std::size_t>(i)])];
    const bool isRemembered = policy.mayBeInterrupted || !isOfPatches(chosen);
    if (!chosen.ofSpheres && isRemembered) contacts_.remember(counterpart_->leavesOf(chosen));
    const float ofPair = counterpart_->traversal().pairError(chosen.pair);
    const float error = chosen.isExact ? std::min(chosen.exactError, ofPair) : ofPair;
    report.errorFraction = std::max(report.errorFraction, double(error) / double(smallerSize_));
    exact += chosen.isExact ? 1 : 0;
  }
  report.contacts += points;
  report.exactContacts += std::min(exact, points);
  report.manifolds += points > 0 ? 1 : 0;
}

// What stopped a body is no guess at what holds it now.
void TreePair::forgetImpulsesAhead() {
  if (wasAhead_)
    for (btPersistentManifold* m : manifolds_)
      for (int i = 0; m && i < m->getNumContacts(); ++i) m->getContactPoint(i).m_appliedImpulse = 0;
  wasAhead_ = !ahead_.empty();
}

void TreePair::promise(Budget& budget, const EmissionPace& pace) {
  budget.redeem(promised_);
  promised_.operations = contacts_.measuringCost(*counterpart_);
  promised_.nanoseconds = pace.expectedNanoseconds(promised_.operations + contacts_.standInCost(*counterpart_));
  budget.promise(promised_);
}

PairReport TreePair::finish(btDispatcher& dispatcher, btManifoldResult& result, const AnswerPolicy& policy,
                            Budget& budget, ContactScratch& scratch) {
  budget.redeem(std::exchange(promised_, {}));
  PairReport report;
  wasDone_ = counterpart_->traversal().done();
  report.isUnresolved = !wasDone_;
  report.errorFraction = double(counterpart_->traversal().worstFrontError()) / double(smallerSize_);
  contacts_.finish(*counterpart_, policy, motion_, reach_, ahead_, budget, scratch);
  report.onTriangles = contacts_.onTriangles();
  answeredAt_ = motion_.placement;
  forgetImpulsesAhead();
  const Clusters clusters = clustersOf(scratch.contacts);
  for (std::size_t k = 0; k < clusters.size(); ++k)
    writeCluster(static_cast<int>(k), clusters[k], policy, dispatcher, result, report);
  if (policy.mayBeInterrupted) contacts_.rememberDeepest(*counterpart_, scratch);
  if (policy.mayBeInterrupted) surviveRefresh();
  if (areGuardsLoaded()) stayAwake();
  report.errorFraction += double(contacts_.overlooked() / smallerSize_);
  heldError_ = report.errorFraction;
  saidContacts_ = report.contacts;
  saidManifolds_ = report.manifolds;
  if (wasDone_) waited_ = 0;
  wholeAt_ = -1;
  axes_ = objects_[1]->getWorldTransform().getBasis();
  return report;
}

}  // namespace cairn::bullet
