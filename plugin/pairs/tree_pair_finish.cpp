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
// Contacts of a cluster that are chosen, measured and chosen from again one by one; more than twice what a heap's need.
constexpr int kRoundsOneByOne = 32;
// The gap of one that others stand for.
constexpr float kReplaced = std::numeric_limits<float>::infinity();

bool canBeSharpened(const Contact& contact) {
  return !contact.isSettled && !contact.ofSpheres;
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

// The contacts that would be chosen are measured between source triangles, and what comes of it is chosen from again,
// until all that are chosen are settled. Triangles are never deeper than their regions (up to what sixteen support
// points leave out), so nothing deeper is left behind, and most contacts never have to be looked at. The first that the
// budget does not cover ends it: what is left when time is up must cost next to nothing.
std::span<Contact> TreePair::goOnToTriangles(std::span<const Contact> cluster, std::span<const ContactId> held,
                                             Budget& budget, ContactScratch& scratch) const {
  std::vector<Contact>& members = scratch.cluster;
  members.assign(cluster.begin(), cluster.end());
  std::size_t more = 0;
  for (int round = 0;; ++round) {
    const ContactChoice choice = chooseContacts(members, held, kSeparationFactor * speculative_, speculative_);
    const auto chosen = std::span(choice.index).first(static_cast<std::size_t>(choice.count));
    const auto open =
        std::ranges::find_if(chosen, [&](int i) { return canBeSharpened(members[static_cast<std::size_t>(i)]); });
    if (open == chosen.end()) return members;
    if (round >= kRoundsOneByOne) more = std::max<std::size_t>(2 * more, kMaxPoints);
    const bool isCovered = sharpen(members, static_cast<std::size_t>(*open), more, budget);
    std::sort(members.begin(), members.end(), deeper);
    while (!members.empty() && members.back().gap == kReplaced) members.pop_back();
    if (!isCovered) return members;
  }
}

// That one, and so many more of the deepest: where most turn out to be in vain, choosing anew for each would take the
// square of their number.
bool TreePair::sharpen(std::vector<Contact>& members, std::size_t one, std::size_t more, Budget& budget) const {
  const auto replace = [&](std::size_t i) {
    Contact rough = members[i];
    rough.isSettled = true;
    if (!counterpart_->sharpen(rough, budget, members)) return false;
    members[i].gap = kReplaced;
    return true;
  };
  if (!replace(one)) return false;
  for (std::size_t i = 0, count = members.size(); i < count && more > 0; ++i) {
    if (i == one || !canBeSharpened(members[i])) continue;
    if (!replace(i)) return false;
    --more;
  }
  return true;
}

void TreePair::writeCluster(int k, btDispatcher& dispatcher, btManifoldResult& result, Finest finest, Budget& budget,
                            ContactScratch& scratch, PairReport& report) {
  std::span<Contact> members = scratch.contacts.cluster(k);
  const bool isHeld = manifolds_[static_cast<std::size_t>(k)] != nullptr;
  if (members.empty() && !isHeld) return;
  btPersistentManifold* const m = manifold(dispatcher, k);
  if (!m) return;
  ManifoldWriter writer(result, origin_, treeIsBody0_, kInheritanceFraction * smallerSize_, motion_);
  const HeldContacts held = writer.held(*m);
  if (finest == Finest::triangles) {
    const auto began = budget.hasDeadline() ? Budget::Clock::now() : Budget::Clock::time_point();
    members = goOnToTriangles(members, held.span(), budget, scratch);
    if (budget.hasDeadline()) report.onTriangles += Budget::Clock::now() - began;
  }
  const ContactChoice choice = chooseContacts(members, held.span(), kSeparationFactor * speculative_, speculative_);
  writer.write(*m, members, choice);

  for (int i = 0; i < choice.count; ++i) {
    const Contact& chosen = members[static_cast<std::size_t>(choice.index[static_cast<std::size_t>(i)])];
    contacts_.remember(chosen);
    const float ofPair = counterpart_->traversal().pairError(chosen.pair);
    const float error = chosen.isExact ? std::min(chosen.exactError, ofPair) : ofPair;
    report.errorFraction = std::max(report.errorFraction, double(error) / double(smallerSize_));
    report.exactContacts += chosen.isExact ? 1 : 0;
  }
  report.contacts += static_cast<std::uint32_t>(choice.count);
  report.manifolds += choice.count > 0 ? 1 : 0;
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
  forgetImpulsesAhead();
  const auto writeAll = [&] {
    for (int k = 0; k < kMaxClusters; ++k) writeCluster(k, dispatcher, result, policy.finest, budget, scratch, report);
  };
  writeAll();
  const bool wereDropped = wasDone_ && report.contacts == 0 && !scratch.contacts.list().empty();
  if (wereDropped && policy.finest == Finest::triangles &&
      contacts_.breakSilence(*counterpart_, reach_, budget, scratch))
    writeAll();
  if (policy.mayBeInterrupted) contacts_.rememberDeepest(scratch);
  if (policy.mayBeInterrupted) surviveRefresh();
  heldError_ = report.errorFraction;
  saidContacts_ = report.contacts;
  saidManifolds_ = report.manifolds;
  if (wasDone_) waited_ = 0;
  wholeAt_ = -1;
  axes_ = objects_[1]->getWorldTransform().getBasis();
  return report;
}

}  // namespace cairn::bullet
