// SPDX-License-Identifier: Zlib
#include "pairs/pair_contacts.h"

#include <algorithm>

#include "kernel/contact_tuning.h"
#include "pairs/contacts_ahead.h"

namespace cairn::bullet {

void PairContacts::expectInterruptions() {
  known_.makeRoom();
  found_.makeRoom();
}

void PairContacts::reset() {
  known_.reset();
  found_.clear();
  guards_.clear();
  normals_.forget();
  seenLeafPairs_ = 0;
  age_ = {};
  started_ = false;
  isResumed_ = false;
  overlooked_ = 0;
  isTold_ = false;
  isKept_ = isOfTriangles_ = false;
  liesStill_ = false;
  kept_.reset();
}

void PairContacts::settleApart(const Vec3& centers) {
  if (started_) reset();
  age_.settleApart(centers);
}

bool PairContacts::begin(Counterpart& counterpart, const RelativeMotion& motion, const Beginning& beginning,
                         Budget& budget, ContactScratch& scratch) {
  isResumed_ = false;
  known_.beginStep();
  counterpart.expect(normals_.normals());
  isKept_ = keepAnswer(counterpart, motion, beginning.remeasured);
  if (isKept_ || isDoneUntold(counterpart, motion)) return false;
  if (!started_ || counterpart.traversal().done() || !counterpart.resume()) {
    start(counterpart, motion);
    return true;
  }
  isResumed_ = true;
  kept_.resume(motion.placement);
  // What would take most of the budget is left to the end, or the traversal would never get anywhere.
  const bool isDear = 2 * kContactCost * known_.pairs().size() > budget.remaining();
  if (!beginning.isHeldOver && !isDear) known_.retest(counterpart, budget, scratch.retested);
  return false;
}

// Its traversal was done in a step in which nobody asked what it found.
bool PairContacts::isDoneUntold(const Counterpart& counterpart, const RelativeMotion& motion) {
  if (!started_ || isTold_ || !counterpart.traversal().done()) return false;
  isResumed_ = kept_.holdsAt(motion.placement, motion.reach);
  return isResumed_;
}

void PairContacts::start(Counterpart& counterpart, const RelativeMotion& motion) {
  counterpart.start(known_.pairs(), kept_.begin(counterpart, motion));
  age_.traversalBegan(0, motion.treeCenter - motion.otherCenter);
  seenLeafPairs_ = 0;
  found_.clear();
  started_ = true;
  isTold_ = false;
}

bool PairContacts::keepAnswer(Counterpart& counterpart, const RelativeMotion& motion, Remeasured remeasured) {
  overlooked_ = 0;
  if (!keepsAt(counterpart, motion.placement, motion.reach)) return false;
  // Between flat faces that lie still, the points of the last step stand for all others.
  const bool isStill = kept_.isStillAt(motion.placement, motion.reach);
  liesStill_ = normals_.areFlat() && isStill;
  const std::span<const NodePair> leafPairs = counterpart.traversal().leafPairs();
  if (liesStill_ && (remeasured == Remeasured::all || kept_.tellsNear(leafPairs.size())))
    remeasured = Remeasured::touching;
  kept_.pick(leafPairs, motion, known_.pairs(), remeasured);
  if (!isStill) overlooked_ = kept_.overlooked();
  age_.traversalBegan(overlooked_, motion.treeCenter - motion.otherCenter);
  return true;
}

// What was resolved in earlier steps is left at what is known of it, unless only all of it together can be told.
std::span<const NodePair> PairContacts::unmeasured(const Counterpart& counterpart) const {
  if (isKept_) return kept_.near();
  const bool anew = counterpart.traversal().done() && counterpart.measuresTogether();
  return counterpart.traversal().leafPairs().subspan(anew ? 0 : seenLeafPairs_);
}

void PairContacts::measureFound(Counterpart& counterpart, Budget& budget, ContactScratch& scratch) {
  const std::span<const NodePair> pairs = counterpart.traversal().leafPairs().subspan(seenLeafPairs_);
  if (pairs.empty()) return;
  budget.chargeAnyway(kContactCost * pairs.size());
  std::vector<Contact>& contacts = scratch.retested;
  contacts.clear();
  counterpart.appendContacts(pairs, contacts);
  found_.add(contacts);
  seenLeafPairs_ += pairs.size();
}

void PairContacts::appendFound(Counterpart& counterpart, Budget& budget, std::vector<Contact>& contacts) {
  if (found_.pairs().empty()) return;  // or what counterparts gather once they would gather in vain
  budget.chargeAnyway(kContactCost * found_.pairs().size());
  counterpart.appendContacts(found_.pairs(), contacts);
  found_.clear();
}

void PairContacts::appendUnmeasured(Counterpart& counterpart, const RelativeMotion& motion, Budget& budget,
                                    std::vector<Contact>& contacts) {
  const std::span<const NodePair> pairs = unmeasured(counterpart);
  const std::size_t leafPairs = counterpart.traversal().leafPairs().size();
  budget.chargeAnyway(kContactCost * pairs.size());
  kept_.makeRoom(leafPairs);
  if (isKept_)
    kept_.measureNear(counterpart, motion, contacts);
  else if (kept_.isWanted() && counterpart.traversal().done() && seenLeafPairs_ == 0)
    kept_.measureAll(counterpart, motion, contacts);
  else
    counterpart.appendContacts(pairs, contacts);
  seenLeafPairs_ = leafPairs;
}

bool PairContacts::appendOfMesh(Counterpart& counterpart, const RelativeMotion& motion, const MeshQuestion& question,
                                std::vector<Contact>& contacts) {
  const bool isTimed = question.finest == Finest::triangles && question.budget.hasDeadline();
  const auto began = isTimed ? Budget::Clock::now() : Budget::Clock::time_point();
  const std::optional<float> gap = counterpart.appendOfMesh(question, contacts);
  if (isTimed) onTriangles_ = Budget::Clock::now() - began;
  if (!gap) return false;
  kept_.setGap(*gap, motion);
  overlooked_ = 0;
  kept_.makeRoom(counterpart.traversal().leafPairs().size());
  seenLeafPairs_ = counterpart.traversal().leafPairs().size();
  return true;
}

std::uint64_t PairContacts::measuringCost(const Counterpart& counterpart) const {
  return kContactCost * unmeasured(counterpart).size();
}

std::uint64_t PairContacts::standInCost(const Counterpart& counterpart) const {
  if (counterpart.traversal().done()) return 0;
  const std::uint64_t known = known_.isRetested() ? 0 : kContactCost * known_.pairs().size();
  return known + kSphereCost * (toldFront(counterpart).size() + 1);
}

float PairContacts::frontError(Counterpart& counterpart) {
  Traversal& traversal = counterpart.traversal();
  const bool isOlder = counterpart.isOfLikeSize() && traversal.front().size() > Traversal::kCoarsePairs;
  return isOlder ? traversal.worstOf(traversal.coarseFront()) : traversal.worstFrontError();
}

std::span<const NodePair> PairContacts::toldFront(const Counterpart& counterpart) {
  const Traversal& traversal = counterpart.traversal();
  if (counterpart.isOfLikeSize()) return traversal.coarseFront();
  return traversal.front().first(std::min(traversal.front().size(), Traversal::kCoarsePairs));
}

void PairContacts::appendFront(Counterpart& counterpart, bool compensate, float reach, Budget& budget,
                               std::vector<Contact>& contacts) {
  const Traversal& traversal = counterpart.traversal();
  const std::span<const NodePair> front = toldFront(counterpart);
  budget.chargeAnyway(kSphereCost * static_cast<std::uint32_t>(front.size()));
  for (const NodePair& pair : front) {
    Contact contact = counterpart.boundingContact(pair);
    if (compensate) contact.gap += traversal.pairError(pair);
    if (contact.gap < reach) contacts.push_back(contact);
  }
}

// An answer that said "in contact" holds while some of its contacts still is one, as far as they have been looked at.
bool PairContacts::hasAnswer(const RelativeMotion& motion) const {
  const bool hasLost = known_.isRetested() && known_.contacts().empty();
  return age_.isAnswered() && age_.isRecent(motion.smallerSize) && !(age_.hadContacts() && hasLost);
}

bool PairContacts::holds(float moved, float smallerSize) const {
  return age_.isAnsweredWithin(moved, smallerSize) ||
         (!guards_.isEmpty() && age_.isTraversedWithin(moved, smallerSize));
}

bool PairContacts::keepsAt(const Counterpart& counterpart, const RelativePlacement& now, float reach) const {
  return isTold_ && counterpart.traversal().done() && kept_.holdsAt(now, reach);
}

// What lay still was asked about little of itself; once it moves, all is asked.
std::uint64_t PairContacts::keptCost(const Counterpart& counterpart, const RelativePlacement& now, float reach) const {
  const std::size_t all = counterpart.traversal().leafPairs().size();
  if (!isKept_ || !kept_.tellsNear(all)) return kContactCost * all;
  if (normals_.areFlat() && kept_.isStillAt(now, reach) && !known_.pairs().empty())
    return kContactCost * known_.pairs().size();
  return kContactCost * (liesStill_ ? all : kept_.wanted());
}

void PairContacts::finish(Counterpart& counterpart, const AnswerPolicy& policy, const RelativeMotion& motion,
                          float reach, std::span<const Contact> ahead, Budget& budget, ContactScratch& scratch) {
  std::vector<Contact>& contacts = scratch.contacts.list();
  contacts.clear();
  const bool isDone = counterpart.traversal().done();
  counterpart.expect(normals_.normals());
  if (!isDone || isResumed_) known_.retest(counterpart, budget, scratch.retested);
  onTriangles_ = {};
  const bool isOfMesh =
      isDone && age_.isTraversalRecent(motion.smallerSize) &&
      appendOfMesh(counterpart, motion,
                   {policy.finest, scratch.kernel, motion.placement, budget, policy.mayBeInterrupted}, contacts);
  if (!isOfMesh) {
    if (known_.isRetested() && !(isDone && counterpart.measuresTogether()))
      contacts.assign(known_.contacts().begin(), known_.contacts().end());
    appendFound(counterpart, budget, contacts);
    appendUnmeasured(counterpart, motion, budget, contacts);
  }
  if (isDone) {
    isTold_ = true;
    age_.traversalEnded(!contacts.empty());
  }
  // What an answer ruled out long ago may have closed in since.
  if (isDone && age_.isRecent(motion.smallerSize))
    guards_.clear();
  else if (policy.unresolved == Unresolved::guard)
    appendGuards(counterpart, motion, reach, budget, scratch);
  else if (!isDone && policy.unresolved != Unresolved::ignore)
    appendFront(counterpart, policy.unresolved == Unresolved::compensate, reach, budget, contacts);
  known_.forgetPairs();
  contacts.insert(contacts.end(), ahead.begin(), ahead.end());
  isOfTriangles_ = isOfMesh && policy.finest == Finest::triangles;
  scratch.contacts.group(normals_.seeds(), reach, isOfTriangles_ ? tuning::kOneManifold : kClusterCosine);
  if (isOfMesh)
    normals_.keep(scratch.contacts);
  else
    normals_.flatten(counterpart, reach, scratch.contacts, scratch.strays);
  dropOverruled(ahead, reach, scratch.contacts);
  if (!counterpart.givesWay()) return;
  for (Contact& contact : contacts)
    if (!contact.ofSpheres) contact.bend = motion.bend(contact);
}

void PairContacts::appendGuards(Counterpart& counterpart, const RelativeMotion& motion, float reach, Budget& budget,
                                ContactScratch& scratch) {
  const std::span<const NodePair> front = toldFront(counterpart);
  budget.chargeAnyway(kSphereCost * front.size());
  std::vector<Contact>& guards = scratch.guards;
  guards.clear();
  float closingSpeed = 0;
  for (const NodePair& pair : front) guards.push_back(counterpart.boundingContact(pair));
  scratch.wholes.clear();
  budget.chargeAnyway(kSphereCost * counterpart.appendWhole(scratch.wholes));
  const bool needsAll = needsWholes(counterpart, motion.smallerSize, scratch.wholes);
  for (const Contact& whole : scratch.wholes) {
    if (!needsAll && (counterpart.isOfLikeSize() || !guards_.had(whole))) continue;
    const auto inFront = std::ranges::find(guards, whole.id, &Contact::id);
    if (inFront == guards.end())
      guards.push_back(whole);
    else
      inFront->isWhole = whole.isWhole;
  }
  for (const Contact& guard : guards) closingSpeed = std::max(closingSpeed, motion.closingSpeed(guard));
  // What was ruled out may close in while the front stands still: a rod that turns about its end.
  age_.approached(closingSpeed * motion.timeStep, motion.greatestSpeed() * motion.timeStep);
  std::erase_if(guards, [&](const Contact& c) { return c.certainDepth <= 0 && !isWanted(c, motion, reach); });
  guards_.choose(guards, motion.smallerSize, scratch.contacts.list());
  budget.chargeAnyway(kContactCost * counterpart.appendCoarse(scratch.contacts.list()));
}

// What the traversal has ruled out was apart when it was tested, and a front that is cut does not hold all there is: of
// all of both only spheres around wholes are known to. Those of bodies of like size say so little that they are only
// worth it where nothing says more.
bool PairContacts::needsWholes(Counterpart& counterpart, float smallerSize, std::span<const Contact> wholes) const {
  Traversal& traversal = counterpart.traversal();
  const bool isCut = traversal.front().size() > Traversal::kCoarsePairs;
  if (!counterpart.isOfLikeSize()) return isCut || !age_.isTraversalRecent(smallerSize);
  float error = 0;
  for (const Contact& whole : wholes) error = std::max(error, traversal.pairError(whole.pair));
  return error <= frontError(counterpart) + age_.sinceTraversal();
}

// Velocities do not tell everything: the solver also shifts bodies to part others.
bool PairContacts::isWanted(const Contact& guard, const RelativeMotion& motion, float reach) const {
  if (guard.gap >= reach) return false;
  const Vec3 centers = motion.treeCenter - motion.otherCenter;
  return !hasAnswer(motion) || age_.haveClosed(centers, guard.normal, motion.smallerSize);
}

}  // namespace cairn::bullet
