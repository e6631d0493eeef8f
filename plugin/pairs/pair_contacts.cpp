// SPDX-License-Identifier: Zlib
#include "pairs/pair_contacts.h"

#include <algorithm>

#include "kernel/contact_tuning.h"
#include "pairs/speculative_contacts.h"

namespace cairn::bullet {

void PairContacts::expectInterruptions() {
  known_.makeRoom();
  found_.makeRoom();
}

void PairContacts::reset() {
  normals_.forget();
  forgetPlaces();
}

void PairContacts::forgetPlaces() {
  known_.reset();
  found_.clear();
  guards_.clear();
  seenLeafPairs_ = 0;
  age_ = {};
  started_ = false;
  isResumed_ = false;
  staleness_ = 0;
  isReported_ = false;
  isCached_ = isOfTriangles_ = false;
  isAtRest_ = false;
  cache_.reset();
}

void PairContacts::cullSeparated(const Vec3& centers) {
  if (started_) reset();
  age_.cullSeparated(centers);
}

bool PairContacts::begin(Collider& collider, const RelativeMotion& motion, const Beginning& beginning, Budget& budget,
                         ContactScratch& scratch) {
  isResumed_ = false;
  known_.beginStep();
  collider.expect(normals_.normals());
  isCached_ = useCache(collider, motion, beginning.refresh);
  if (isCached_ || isDoneUnreported(collider, motion)) return false;
  if (!started_ || collider.traversal().done() || !collider.resume()) {
    start(collider, motion);
    return true;
  }
  isResumed_ = true;
  cache_.resume(motion.placement);
  // Measuring that takes most of the budget is left to the end; otherwise the traversal would never proceed.
  const bool isDear = 2 * kContactCost * known_.pairs().size() > budget.remaining();
  if (!beginning.isCarriedOver && !isDear) known_.retest(collider, budget, scratch.retested);
  return false;
}

// Whether the traversal was done in a step in which nobody asked for its contacts.
bool PairContacts::isDoneUnreported(const Collider& collider, const RelativeMotion& motion) {
  if (!started_ || isReported_ || !collider.traversal().done()) return false;
  isResumed_ = cache_.holdsAt(motion.placement, motion.maxSeparation);
  return isResumed_;
}

void PairContacts::start(Collider& collider, const RelativeMotion& motion) {
  collider.start(known_.pairs(), cache_.begin(collider, motion));
  age_.traversalBegan(0, motion.treeCenter - motion.otherCenter);
  seenLeafPairs_ = 0;
  found_.clear();
  started_ = true;
  isReported_ = false;
}

bool PairContacts::useCache(Collider& collider, const RelativeMotion& motion, RefreshPolicy refresh) {
  staleness_ = 0;
  if (!keepsAt(collider, motion.placement, motion.maxSeparation)) return false;
  // Between flat faces at rest, the points of the last step represent all others.
  const bool isStill = cache_.isStillAt(motion.placement, motion.maxSeparation);
  isAtRest_ = normals_.areFlat() && isStill;
  const std::span<const NodePair> leafPairs = collider.traversal().leafPairs();
  if (isAtRest_ && (refresh == RefreshPolicy::all || cache_.tellsNear(leafPairs.size())))
    refresh = RefreshPolicy::touching;
  cache_.select(leafPairs, motion, known_.pairs(), refresh);
  if (!isStill) staleness_ = cache_.staleness();
  age_.traversalBegan(staleness_, motion.treeCenter - motion.otherCenter);
  return true;
}

// Leaf pairs of earlier steps keep their remembered contacts, unless the collider must measure all of them together.
std::span<const NodePair> PairContacts::unmeasured(const Collider& collider) const {
  if (isCached_) return cache_.near();
  const bool anew = collider.traversal().done() && collider.measuresTogether();
  return collider.traversal().leafPairs().subspan(anew ? 0 : seenLeafPairs_);
}

void PairContacts::measureFound(Collider& collider, Budget& budget, ContactScratch& scratch) {
  const std::span<const NodePair> pairs = collider.traversal().leafPairs().subspan(seenLeafPairs_);
  if (pairs.empty()) return;
  budget.forceCharge(kContactCost * pairs.size());
  std::vector<Contact>& contacts = scratch.retested;
  contacts.clear();
  collider.appendContacts(pairs, contacts);
  found_.add(contacts);
  seenLeafPairs_ += pairs.size();
}

void PairContacts::appendFound(Collider& collider, Budget& budget, std::vector<Contact>& contacts) {
  if (found_.pairs().empty()) return;  // else colliders would gather their data in vain
  budget.forceCharge(kContactCost * found_.pairs().size());
  collider.appendContacts(found_.pairs(), contacts);
  found_.clear();
}

void PairContacts::appendUnmeasured(Collider& collider, const RelativeMotion& motion, Budget& budget,
                                    std::vector<Contact>& contacts) {
  const std::span<const NodePair> pairs = unmeasured(collider);
  const std::size_t leafPairs = collider.traversal().leafPairs().size();
  budget.forceCharge(kContactCost * pairs.size());
  cache_.makeRoom(leafPairs);
  if (isCached_)
    cache_.measureNear(collider, motion, contacts);
  else if (cache_.isWanted() && collider.traversal().done() && seenLeafPairs_ == 0)
    cache_.measureAll(collider, motion, contacts);
  else
    collider.appendContacts(pairs, contacts);
  seenLeafPairs_ = leafPairs;
}

bool PairContacts::appendOfMesh(Collider& collider, const RelativeMotion& motion, const MeshQuery& question,
                                std::vector<Contact>& contacts) {
  const bool isTimed = question.finest == Finest::triangles && question.budget.hasDeadline();
  const auto began = isTimed ? Budget::Clock::now() : Budget::Clock::time_point();
  const std::optional<float> separation = collider.appendOfMesh(question, contacts);
  if (isTimed) onTriangles_ = Budget::Clock::now() - began;
  if (!separation) return false;
  cache_.setSeparation(*separation, motion);
  staleness_ = 0;
  cache_.makeRoom(collider.traversal().leafPairs().size());
  seenLeafPairs_ = collider.traversal().leafPairs().size();
  return true;
}

std::uint64_t PairContacts::measuringCost(const Collider& collider) const {
  return kContactCost * unmeasured(collider).size();
}

std::uint64_t PairContacts::fallbackCost(const Collider& collider) const {
  if (collider.traversal().done()) return 0;
  const std::uint64_t known = known_.isRetested() ? 0 : kContactCost * known_.pairs().size();
  return known + kSphereCost * (reportedFront(collider).size() + 1);
}

float PairContacts::frontError(Collider& collider) {
  Traversal& traversal = collider.traversal();
  const bool isOlder = collider.hasSimilarSize() && traversal.front().size() > Traversal::kCoarsePairs;
  return isOlder ? traversal.worstOf(traversal.coarseFront()) : traversal.worstFrontError();
}

std::span<const NodePair> PairContacts::reportedFront(const Collider& collider) {
  const Traversal& traversal = collider.traversal();
  if (collider.hasSimilarSize()) return traversal.coarseFront();
  return traversal.front().first(std::min(traversal.front().size(), Traversal::kCoarsePairs));
}

void PairContacts::appendFront(Collider& collider, bool compensate, float maxSeparation, Budget& budget,
                               std::vector<Contact>& contacts) {
  const Traversal& traversal = collider.traversal();
  const std::span<const NodePair> front = reportedFront(collider);
  budget.forceCharge(kSphereCost * static_cast<std::uint32_t>(front.size()));
  for (const NodePair& pair : front) {
    Contact contact = collider.boundingContact(pair);
    if (compensate) contact.separation += traversal.pairError(pair);
    if (contact.separation < maxSeparation) contacts.push_back(contact);
  }
}

// An answer with contacts holds while one of its contacts remains, as far as they were measured.
bool PairContacts::hasAnswer(const RelativeMotion& motion) const {
  const bool hasLost = known_.isRetested() && known_.contacts().empty();
  return age_.isAnswered() && age_.isRecent(motion.smallerSize) && !(age_.hadContacts() && hasLost);
}

bool PairContacts::holds(float moved, float smallerSize) const {
  return age_.isAnsweredWithin(moved, smallerSize) ||
         (!guards_.isEmpty() && age_.isTraversedWithin(moved, smallerSize));
}

bool PairContacts::keepsAt(const Collider& collider, const RelativePlacement& now, float maxSeparation) const {
  return isReported_ && collider.traversal().done() && cache_.holdsAt(now, maxSeparation);
}

// Only few pairs of bodies at rest were measured; once they move, all are measured.
std::uint64_t PairContacts::cachedCost(const Collider& collider, const RelativePlacement& now,
                                       float maxSeparation) const {
  const std::size_t all = collider.traversal().leafPairs().size();
  if (!isCached_ || !cache_.tellsNear(all)) return kContactCost * all;
  if (normals_.areFlat() && cache_.isStillAt(now, maxSeparation) && !known_.pairs().empty())
    return kContactCost * known_.pairs().size();
  return kContactCost * (isAtRest_ ? all : cache_.wanted());
}

void PairContacts::finish(Collider& collider, const AnswerPolicy& policy, const RelativeMotion& motion,
                          float maxSeparation, std::span<const Contact> speculative, Budget& budget,
                          ContactScratch& scratch) {
  std::vector<Contact>& contacts = scratch.contacts.list();
  contacts.clear();
  const bool isDone = collider.traversal().done();
  collider.expect(normals_.normals());
  if (!isDone || isResumed_) known_.retest(collider, budget, scratch.retested);
  onTriangles_ = {};
  const bool isOfMesh =
      isDone && age_.isTraversalRecent(motion.smallerSize) &&
      appendOfMesh(collider, motion, {policy.finest, scratch.kernel, motion.placement, budget, policy.mayBeInterrupted},
                   contacts);
  if (!isOfMesh) {
    if (known_.isRetested() && !(isDone && collider.measuresTogether()))
      contacts.assign(known_.contacts().begin(), known_.contacts().end());
    appendFound(collider, budget, contacts);
    appendUnmeasured(collider, motion, budget, contacts);
  }
  std::erase_if(contacts, [&](const Contact& c) { return c.separation > motion.reported && !motion.meetsSoon(c); });
  if (isDone) {
    isReported_ = true;
    age_.traversalEnded(!contacts.empty());
  }
  // Surfaces that an answer ruled out long ago may have approached since.
  if (isDone && age_.isRecent(motion.smallerSize))
    guards_.clear();
  else if (policy.unresolved == Unresolved::guard)
    appendGuards(collider, motion, maxSeparation, budget, scratch);
  else if (!isDone && policy.unresolved != Unresolved::ignore)
    appendFront(collider, policy.unresolved == Unresolved::compensate, maxSeparation, budget, contacts);
  known_.forgetPairs();
  contacts.insert(contacts.end(), speculative.begin(), speculative.end());
  isOfTriangles_ = isOfMesh && policy.finest == Finest::triangles;
  scratch.contacts.group(normals_.seeds(), maxSeparation, isOfTriangles_ ? tuning::kOneManifold : kClusterCosine);
  if (isOfMesh)
    normals_.keep(scratch.contacts);
  else
    normals_.alignNormals(collider, maxSeparation, scratch.contacts, scratch.outliers);
  dropOverruled(speculative, maxSeparation, scratch.contacts);
  if (!collider.usesCurvatureCorrection()) return;
  for (Contact& contact : contacts)
    if (!contact.ofSpheres) contact.curvatureCorrection = motion.curvatureCorrection(contact);
}

void PairContacts::appendGuards(Collider& collider, const RelativeMotion& motion, float maxSeparation, Budget& budget,
                                ContactScratch& scratch) {
  const std::span<const NodePair> front = reportedFront(collider);
  budget.forceCharge(kSphereCost * front.size());
  std::vector<Contact>& guards = scratch.guards;
  guards.clear();
  float closingSpeed = 0;
  for (const NodePair& pair : front) guards.push_back(collider.boundingContact(pair));
  scratch.rootContacts.clear();
  budget.forceCharge(kSphereCost * collider.appendRootContacts(scratch.rootContacts));
  const bool needsAll = needsRootContacts(collider, motion.smallerSize, scratch.rootContacts);
  for (const Contact& whole : scratch.rootContacts) {
    if (!needsAll && (collider.hasSimilarSize() || !guards_.had(whole))) continue;
    const auto inFront = std::ranges::find(guards, whole.id, &Contact::id);
    if (inFront == guards.end())
      guards.push_back(whole);
    else
      inFront->isRootContact = whole.isRootContact;
  }
  for (const Contact& guard : guards) closingSpeed = std::max(closingSpeed, motion.closingSpeed(guard));
  // Surfaces that were ruled out may approach while the front stands still: a rod that turns about its end.
  age_.approached(closingSpeed * motion.timeStep, motion.greatestSpeed() * motion.timeStep);
  std::erase_if(guards, [&](const Contact& c) { return c.certainDepth <= 0 && !isWanted(c, motion, maxSeparation); });
  guards_.choose(guards, motion.smallerSize, scratch.contacts.list());
  budget.forceCharge(kContactCost * collider.appendCoarse(scratch.contacts.list()));
}

// Surfaces that the traversal ruled out were separated only when they were tested, and a cut front does not contain all
// the rest. Only root spheres are known to contain both. Root spheres of like size say so little that they are used
// only where nothing else answers.
bool PairContacts::needsRootContacts(Collider& collider, float smallerSize,
                                     std::span<const Contact> rootContacts) const {
  Traversal& traversal = collider.traversal();
  const bool isCut = traversal.front().size() > Traversal::kCoarsePairs;
  if (!collider.hasSimilarSize()) return isCut || !age_.isTraversalRecent(smallerSize);
  float error = 0;
  for (const Contact& whole : rootContacts) error = std::max(error, traversal.pairError(whole.pair));
  return error <= frontError(collider) + age_.sinceTraversal();
}

// Velocities do not explain all motion: the solver also moves bodies to separate others.
bool PairContacts::isWanted(const Contact& guard, const RelativeMotion& motion, float maxSeparation) const {
  if (guard.separation >= maxSeparation) return false;
  const Vec3 centers = motion.treeCenter - motion.otherCenter;
  return !hasAnswer(motion) || age_.haveClosed(centers, guard.normal, motion.smallerSize);
}

}  // namespace cairn::bullet
