// SPDX-License-Identifier: Zlib
#include "pairs/pair_contacts.h"

#include <algorithm>

namespace cairn::bullet {

namespace {

// Comparing two bounding spheres moves one of them.
constexpr std::uint32_t kSphereCost = kSphereUpdateCost + kOverlapTestCost;
// How far bodies may approach each other, as a fraction of the smaller one's size, before an old answer counts for
// nothing. For a body of one metre and steps of 1/60 s this is 0.5 m/s in a single step, or less speed for longer.
constexpr float kApproachFraction = 0.008F;
// How far bodies may move, as a fraction of the same, while contacts that follow them stand for an answer.
constexpr float kHeldFraction = 0.03F;

}  // namespace

// Bodies may roll for minutes before as much is known of a pair as can be.
PairContacts::PairContacts() {
  guards_.reserve(kMaxGuards);
  known_.reserve(kMaxKnown);
}

void PairContacts::makeRoomForRetests() {
  retested_.reserve(kMaxKnown);
  found_.makeRoom();
}

void PairContacts::reset() {
  known_.clear();
  retested_.clear();
  found_.clear();
  guards_.clear();
  seeds_ = {};
  commonNormals_ = {};
  seenLeafPairs_ = 0;
  isAnswered_ = false;
  answerHadContacts_ = false;
  answer_ = {};
  traversal_ = {};
  started_ = false;
  isResumed_ = false;
  isRetested_ = false;
  isKept_ = false;
  isFlat_ = false;
  kept_.reset();
}

void PairContacts::settleApart(const Vec3& centers) {
  if (started_) reset();
  isAnswered_ = true;
  answer_ = {0, centers};
}

bool PairContacts::begin(Counterpart& counterpart, const RelativeMotion& motion, const Beginning& beginning,
                         Budget& budget, ContactScratch& scratch) {
  isResumed_ = isRetested_ = false;
  counterpart.expect(commonNormals_);
  isKept_ = keepAnswer(counterpart, motion, beginning.isThrifty);
  if (isKept_) return false;
  if (!started_ || counterpart.traversal().done() || !counterpart.resume()) {
    start(counterpart, motion);
    return true;
  }
  isResumed_ = true;
  kept_.resume(motion.placement);
  if (!beginning.isHeldOver) retest(counterpart, budget, scratch);
  return false;
}

void PairContacts::start(Counterpart& counterpart, const RelativeMotion& motion) {
  counterpart.start(known_, kept_.begin(counterpart, motion));
  traversal_ = {0, motion.treeCenter - motion.otherCenter};
  seenLeafPairs_ = 0;
  found_.clear();
  started_ = true;
}

bool PairContacts::keepAnswer(Counterpart& counterpart, const RelativeMotion& motion, bool isThrifty) {
  if (!started_ || !counterpart.traversal().done() || !kept_.holdsAt(motion.placement, motion.reach)) return false;
  traversal_ = {0, motion.treeCenter - motion.otherCenter};
  // Between flat faces that lie still, the points of the last step stand for all others.
  kept_.pick(counterpart.traversal().leafPairs(), motion, known_, isThrifty || (isFlat_ && kept_.isStill(motion)));
  return true;
}

// Each pair may have dozens of contacts; beyond what there is room for, the deepest are kept. The room is made at once:
// bodies that roll would else need a little more for minutes.
void PairContacts::retest(Counterpart& counterpart, Budget& budget, ContactScratch& scratch) {
  if (isRetested_) return;
  isRetested_ = true;
  budget.chargeAnyway(kContactCost * static_cast<std::uint32_t>(known_.size()));
  std::vector<Contact>& all = scratch.retested;
  all.clear();
  counterpart.appendContacts(known_, all);
  if (all.size() > kMaxRetested) std::partial_sort(all.begin(), all.begin() + kMaxRetested, all.end(), deeper);
  const std::size_t count = std::min(all.size(), kMaxRetested);
  retested_.reserve(count <= kMaxKnown ? kMaxKnown : kMaxRetested);
  retested_.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
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

bool PairContacts::appendOfMesh(Counterpart& counterpart, const RelativeMotion& motion, Budget& budget,
                                std::vector<Contact>& contacts) {
  const std::optional<float> gap = counterpart.appendOfMesh(budget, contacts);
  if (!gap) return false;
  kept_.setGap(*gap, motion);
  kept_.makeRoom(counterpart.traversal().leafPairs().size());
  seenLeafPairs_ = counterpart.traversal().leafPairs().size();
  return true;
}

std::uint64_t PairContacts::measuringCost(const Counterpart& counterpart) const {
  return kContactCost * unmeasured(counterpart).size();
}

std::uint64_t PairContacts::standInCost(const Counterpart& counterpart) const {
  if (counterpart.traversal().done()) return 0;
  const std::uint64_t known = isRetested_ ? 0 : kContactCost * known_.size();
  return known + kSphereCost * (std::min(counterpart.traversal().front().size(), kMaxFrontPairs) + 1);
}

namespace {

// Breadth-first: the head of the front holds the coarsest pairs, which reach farthest.
std::span<const NodePair> headOf(std::span<const NodePair> front) {
  return front.first(std::min(front.size(), PairContacts::kMaxFrontPairs));
}

void appendFront(Counterpart& counterpart, bool compensate, float reach, Budget& budget,
                 std::vector<Contact>& contacts) {
  const Traversal& traversal = counterpart.traversal();
  const std::span<const NodePair> front = headOf(traversal.front());
  budget.chargeAnyway(kSphereCost * static_cast<std::uint32_t>(front.size()));
  for (const NodePair& pair : front) {
    Contact contact = counterpart.boundingContact(pair);
    if (compensate) contact.gap += traversal.pairError(pair);
    if (contact.gap < reach) contacts.push_back(contact);
  }
}

}  // namespace

// What overlaps for certain first, then the spheres of the whole bodies, then the deepest of each direction, then the
// deepest of all: what overlaps a wall must not be all that is left of the floor.
std::size_t PairContacts::putChosenFirst(std::vector<Contact>& guards) {
  std::sort(guards.begin(), guards.end(), deeper);
  std::size_t count = 0;
  const auto choose = [&](const auto& isChoice) {
    for (std::size_t i = count; i < guards.size() && count < kMaxGuards; ++i) {
      if (!isChoice(guards[i])) continue;
      const auto first = guards.begin() + static_cast<std::ptrdiff_t>(count);
      const auto it = guards.begin() + static_cast<std::ptrdiff_t>(i);
      std::rotate(first, it, it + 1);
      ++count;
    }
  };
  const auto certain = std::ranges::max_element(guards, {}, &Contact::certainDepth);
  if (certain != guards.end() && certain->certainDepth > 0) {
    std::rotate(guards.begin(), certain, certain + 1);
    ++count;
  }
  choose([](const Contact& c) { return c.isWhole; });
  choose([&](const Contact& c) {
    return std::none_of(guards.begin(), guards.begin() + static_cast<std::ptrdiff_t>(count),
                        [&](const Contact& chosen) { return dot(chosen.normal, c.normal) > kSameWayCosine; });
  });
  choose([](const Contact&) { return true; });
  return count;
}

void PairContacts::appendGuards(Counterpart& counterpart, const RelativeMotion& motion, float reach, Budget& budget,
                                ContactScratch& scratch) {
  const std::span<const NodePair> front = headOf(counterpart.traversal().front());
  budget.chargeAnyway(kSphereCost * static_cast<std::uint32_t>(front.size()));
  std::vector<Contact>& guards = scratch.guards;
  guards.clear();
  float closingSpeed = 0;
  for (const NodePair& pair : front) guards.push_back(counterpart.boundingContact(pair));
  // What the traversal has ruled out was apart when it was tested: after some motion only the whole bodies' spheres are
  // known to hold all of it.
  const bool isStale = traversal_.approach > kApproachFraction * motion.smallerSize;
  const bool isCut = front.size() < counterpart.traversal().front().size();
  scratch.wholes.clear();
  budget.chargeAnyway(kSphereCost * counterpart.appendWhole(scratch.wholes));
  for (const Contact& whole : scratch.wholes) {
    if (!isStale && !isCut && !lastOf(whole)) continue;
    const auto inFront = std::ranges::find(guards, whole.id, &Contact::id);
    if (inFront == guards.end())
      guards.push_back(whole);
    else
      inFront->isWhole = whole.isWhole;
  }
  for (const Contact& guard : guards) closingSpeed = std::max(closingSpeed, motion.closingSpeed(guard));
  answer_.approach += closingSpeed * motion.timeStep;
  // What was ruled out may close in while the front stands still: a rod that turns about its end.
  traversal_.approach += motion.greatestSpeed() * motion.timeStep;
  std::erase_if(guards, [&](const Contact& c) { return c.certainDepth <= 0 && !isWanted(c, motion, reach); });
  const std::size_t count = putChosenFirst(guards);
  std::array<Guard, kMaxGuards> now;
  for (std::size_t i = 0; i < count; ++i) {
    const float allowed = allowedGap(guards[i]);
    // What it forgives is what spheres hold beyond the bodies: not how far these overlap for certain.
    guards[i].gap -= allowed;
    if (guards[i].certainDepth > 0) guards[i].gap = std::min(guards[i].gap, -guards[i].certainDepth);
    now[i] = {guards[i].id, guards[i].isWhole, guards[i].normal, allowed, std::max(-guards[i].gap, 0.0F)};
    scratch.contacts.list().push_back(guards[i]);
  }
  guards_.assign(now.begin(), now.begin() + count);
  budget.chargeAnyway(kContactCost * counterpart.appendCoarse(scratch.contacts.list()));
}

// The same guard in the last step. Of whole bodies it is the one that faced the same way, whatever is nearest now: one
// for the floor says nothing about a wall.
const PairContacts::Guard* PairContacts::lastOf(const Contact& guard) const {
  const Guard* best = nullptr;
  float cosine = kSameWayCosine;
  for (const Guard& g : guards_) {
    const float c = dot(g.normal, guard.normal);
    if (!guard.isWhole || !g.isWhole || c <= cosine) continue;
    best = &g;
    cosine = c;
  }
  if (best) return best;
  const auto same = std::ranges::find(guards_, guard.id, &Guard::id);
  return same == guards_.end() ? nullptr : &*same;
}

// Where a guard is first seen it has depth zero. The solver only slows what has depth zero, so a guard remembers where
// it was and reports what its spheres have sunk since; when they part, it follows. Where refinement has replaced the
// spheres by finer ones, those inherit what the guards that faced the same way had sunk: else every step of a slow
// traversal would start anew from zero, and bodies creep through each other.
float PairContacts::allowedGap(const Contact& guard) const {
  const float now = std::min(guard.gap, 0.0F);
  if (const Guard* last = lastOf(guard)) return std::max(last->allowedGap, now);
  float sunk = 0;
  for (const Guard& g : guards_) {
    if (dot(g.normal, guard.normal) > kSameWayCosine) sunk = std::max(sunk, g.sunk);
  }
  return now + sunk;
}

// Velocities do not tell everything: the solver also shifts bodies to part others.
bool PairContacts::isWanted(const Contact& guard, const RelativeMotion& motion, float reach) const {
  if (guard.gap >= reach) return false;
  const Vec3 moved = motion.treeCenter - motion.otherCenter - answer_.centers;
  return !hasAnswer(motion) || -dot(guard.normal, moved) > kApproachFraction * motion.smallerSize;
}

// An answer that said "in contact" holds while some of its contacts still is one, as far as they have been looked at.
bool PairContacts::hasAnswer(const RelativeMotion& motion) const {
  return isAnswered_ && isRecent(motion) && (!answerHadContacts_ || !isRetested_ || !retested_.empty());
}

bool PairContacts::isAnsweredWithin(float moved, float smallerSize) const {
  return isAnswered_ && answer_.approach + moved <= kHeldFraction * smallerSize;
}

bool PairContacts::holds(float moved, float smallerSize) const {
  return isAnsweredWithin(moved, smallerSize) || isGuardedWithin(moved, smallerSize);
}

bool PairContacts::isGuardedWithin(float moved, float smallerSize) const {
  return !guards_.empty() && traversal_.approach + moved <= kHeldFraction * smallerSize;
}

bool PairContacts::isSilenceOld(float moved, float smallerSize) const {
  return answer_.approach + moved > kApproachFraction * smallerSize;
}

Contact PairContacts::holdWhole(Contact whole) {
  const float allowed = allowedGap(whole);
  const Guard* const last = lastOf(whole);
  whole.gap -= allowed;
  const Guard guard{whole.id, true, whole.normal, allowed, std::max(-whole.gap, 0.0F)};
  if (last)
    guards_[static_cast<std::size_t>(last - guards_.data())] = guard;
  else if (guards_.size() < kMaxGuards)
    guards_.push_back(guard);
  else
    guards_.back() = guard;
  return whole;
}

void PairContacts::waited(float moved) {
  answer_.approach += moved;
  traversal_.approach += moved;
}

bool PairContacts::keepsAt(const Counterpart& counterpart, const RelativePlacement& now, float reach) const {
  return started_ && counterpart.traversal().done() && kept_.holdsAt(now, reach);
}

std::uint64_t PairContacts::keptCost(const Counterpart& counterpart) const {
  return kContactCost * (isKept_ ? kept_.near().size() : counterpart.traversal().leafPairs().size());
}

bool PairContacts::isRecent(const RelativeMotion& motion) const {
  return answer_.approach <= kApproachFraction * motion.smallerSize;
}

void PairContacts::replaceAll(std::span<const Contact> contacts, float reach, ContactScratch& scratch) {
  scratch.contacts.list().assign(contacts.begin(), contacts.end());
  seeds_ = scratch.seeds;
  scratch.contacts.group(seeds_, reach);
  commonNormals_.fill({});  // these are of what crosses, and say nothing of how leaves are to be measured
  isFlat_ = false;
  answerHadContacts_ = true;
}

void PairContacts::finish(Counterpart& counterpart, const AnswerPolicy& policy, const RelativeMotion& motion,
                          float reach, std::span<const Contact> ahead, Budget& budget, ContactScratch& scratch) {
  std::vector<Contact>& contacts = scratch.contacts.list();
  contacts.clear();
  const bool isDone = counterpart.traversal().done();
  counterpart.expect(commonNormals_);
  if (!isDone || isResumed_) retest(counterpart, budget, scratch);
  isOfMesh_ = isDone && traversal_.approach <= kApproachFraction * motion.smallerSize &&
              appendOfMesh(counterpart, motion, budget, contacts);
  if (!isOfMesh_) {
    if (isRetested_ && !(isDone && counterpart.measuresTogether())) contacts = retested_;
    appendFound(counterpart, budget, contacts);
    appendUnmeasured(counterpart, motion, budget, contacts);
  }
  if (isDone) {
    isAnswered_ = true;
    answer_ = traversal_;  // it is as old as its beginning: what was apart then may touch now
    answerHadContacts_ = !contacts.empty();
  }
  // What an answer ruled out long ago may have closed in since.
  if (isDone && isRecent(motion))
    guards_.clear();
  else if (policy.unresolved == Unresolved::guard)
    appendGuards(counterpart, motion, reach, budget, scratch);
  else if (!isDone && policy.unresolved != Unresolved::ignore)
    appendFront(counterpart, policy.unresolved == Unresolved::compensate, reach, budget, contacts);
  known_.clear();
  contacts.insert(contacts.end(), ahead.begin(), ahead.end());
  scratch.seeds = seeds_;
  scratch.contacts.group(seeds_, reach);
  if (isOfMesh_)
    keepNormals(scratch.contacts);
  else
    flatten(counterpart, reach, scratch);
  dropOverruled(ahead, reach, scratch);
  if (!counterpart.givesWay()) return;
  for (Contact& contact : contacts)
    if (!contact.ofSpheres) contact.bend = motion.bend(contact);
}

void PairContacts::remember(const Contact& chosen) {
  if (!chosen.ofSpheres && !isKnown(chosen.pair)) known_.push_back(chosen.pair);
}

bool PairContacts::isKnown(const NodePair& pair) const {
  return std::find(known_.begin(), known_.end(), pair) != known_.end();
}

void PairContacts::rememberDeepest(ContactScratch& scratch) {
  makeRoomForRetests();
  std::vector<Contact>& contacts = scratch.contacts.list();
  const std::size_t count = std::min(contacts.size(), kMaxKnownPairs);
  std::partial_sort(contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(count), contacts.end(), deeper);
  for (std::size_t i = 0; i < count && known_.size() < kMaxKnownPairs; ++i) remember(contacts[i]);
}

}  // namespace cairn::bullet
