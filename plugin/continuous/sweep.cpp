// SPDX-License-Identifier: Zlib
#include "continuous/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "contacts/normal_clusters.h"
#include "contacts/relative_placement.h"
#include "placement/tree_pose.h"

namespace cairn::bullet {

namespace {

// Radians that a tree may turn against the other within a segment. Points of a leaf are then beside its straight path
// by up to a fifth of its radius.
constexpr btScalar kTurn = btScalar(0.2);
// Charges: moving a sphere and testing it once; measuring a leaf pair moves two.
constexpr std::uint32_t kTestCost = kSphereUpdateCost + kOverlapTestCost;
constexpr std::uint32_t kLeafCost = 2 * kSphereUpdateCost + kOverlapTestCost;
// Steps. By then a body that had sunk in is out, or else is pressed in, and its old pose no longer helps.
constexpr int kMaxSlowSteps = 30;
// A floor may deflect a body into the two walls of a corner.
constexpr int kDeflections = 2;

// Fraction of the other side's radius. A leaf with a larger certified error may place its surface too roughly to be met
// as a whole.
constexpr float kCrudeFraction = 0.25F;
// The same limit for the moved tree's own leaves, as a fraction of its radius: one contact for each leaf would not hold
// it.
constexpr float kCrudeInBody = 0.05F;
constexpr int kNone = std::numeric_limits<int>::min();

// The distance of the other side's farthest point from the origin of its frame.
float reachOf(const btCollisionShape& shape) {
  btVector3 center;
  btScalar radius = 0;
  shape.getBoundingSphere(center, radius);
  return static_cast<float>(center.length() + radius);
}

}  // namespace

const std::vector<Contact>& Sweep::run(const SweptPair& pair, Budget& budget) {
  const SphereTreeShape* const other = asSphereTree(pair.other);
  if (!other || other->size() >= pair.tree->size()) {
    sweep(pair, budget);
    return contacts_;
  }
  sweep({other, pair.tree, pair.otherTrajectory, pair.treeTrajectory, pair.origin, pair.maxSeparation, pair.isFast},
        budget);
  for (Contact& contact : contacts_) swapSides(contact);
  return contacts_;
}

void Sweep::swapSides(Contact& contact) {
  contact.normal = -contact.normal;
  contact.separationVector = -contact.separationVector;
  contact.treeIsLarger = true;
  std::swap(contact.pair.a, contact.pair.b);
  contact.id = {contact.id.otherPart, contact.id.otherIndex, contact.id.treePart, contact.id.treeIndex};
}

void Sweep::sweep(const SweptPair& pair, Budget& budget) {
  contacts_.clear();
  tests_ = 0;
  otherReach_ = reachOf(*pair.other);
  follow(pair, true, budget);
  bool isSunk = false;
  for (const Meeting& m : meetings_) {
    if (m.isContact) addContactsOf(m);
    isSunk = isSunk || (m.isContact && m.at < 0);
  }
  markSecondary();
  const bool isIn = !sunkFloors_.empty();
  if (pair.isFast) deflect(pair, budget);
  slowSteps_ = pair.isFast ? 0 : slowSteps_ + 1;
  if ((isSunk || (isIn && anchor_)) && slowSteps_ < kMaxSlowSteps) return;
  anchor_.reset();
  // A body that was placed inside a floor has no pose in front of it to remember.
  if (pair.isFast && !isIn) anchor_ = frame_->at(0);
}

void Sweep::addContactsOf(const Meeting& meeting) {
  contacts_.push_back(meeting.contact);
  for (std::size_t i = 0; i < meeting.besideCount; ++i) {
    contacts_.push_back(meeting.contact);
    contacts_.back().position += meeting.beside[i];
  }
}

const Sweep::Meeting* Sweep::firstMeeting() const {
  const auto earlier = [](const Meeting& x, const Meeting& y) {
    return (x.isContact ? x.at : kNotMet) < (y.isContact ? y.at : kNotMet);
  };
  const auto first = std::ranges::min_element(meetings_, earlier);
  return first == meetings_.end() || !first->isContact ? nullptr : &*first;
}

// A ball that comes straight down onto a plate also meets the far side of the plate's next leaf, along a tilted line.
// By then the ball has stopped elsewhere, so such later meetings do not bounce.
void Sweep::markSecondary() {
  const Meeting* const first = firstMeeting();
  if (!first) return;
  for (Contact& contact : contacts_)
    contact.isSecondary = dot(contact.normal, first->contact.normal) < kSameNormalCosine;
}

// A body stopped by a floor goes on along it, and may hit a wall of the same body within the step. Then it goes on
// along both, perhaps into a third.
void Sweep::deflect(SweptPair pair, Budget& budget) {
  for (int turn = 0; turn < kDeflections; ++turn) {
    const Meeting* const first = firstMeeting();
    if (!first) return;
    const Vec3 normal = first->contact.normal;
    pair.treeTrajectory = pair.treeTrajectory.along(toBullet(normal), pair.otherTrajectory);
    follow(pair, false, budget);
    for (const Meeting& m : meetings_)
      if (m.isContact && dot(m.contact.normal, normal) < kSameMotionCosine) addContactsOf(m);
  }
}

void Sweep::follow(const SweptPair& pair, bool fromAnchor, Budget& budget) {
  meetings_.clear();
  sunkFloors_.clear();
  cut(pair, fromAnchor);
  if (target_->rootCount() == 0) return;
  meetingOf_.assign(segments_.front().tree.tree().traversalNodes().size(), kNone);
  for (const Segment& s : segments_) {
    // A part that was met on the way from the anchor, and is still in front of the surface, may meet it now.
    if (s.from == 0)
      for (Meeting& m : meetings_)
        if (!m.isContact) m.at = kNotMet;
    search(pair, s, budget);
  }
  keepAboveFloors(pair);
}

SweptPlace Sweep::placeAt(float part) const {
  if (part >= 0) return frame_->at(btScalar(part));
  return placeBetween(frame_->at(0), *anchor_, -btScalar(part));
}

// Cuts the motion into segments. Also gives the target the space that the motion needs.
void Sweep::cut(const SweptPair& pair, bool fromAnchor) {
  segments_.clear();
  const bool otherIsSmaller = !asSphereTree(pair.other) && otherReach_ < pair.tree->size();
  frame_.emplace(pair.treeTrajectory, pair.otherTrajectory, otherIsSmaller);
  if (anchor_ && fromAnchor) append(pair, -1, 0, turnBetween(*anchor_, frame_->at(0)));
  if (pair.isFast) append(pair, 0, 1, pair.treeTrajectory.turn() + pair.otherTrajectory.turn());
  btVector3 lower(SIMD_INFINITY, SIMD_INFINITY, SIMD_INFINITY), upper = -lower;
  for (const Segment& s : segments_) {
    const MovedNode root = moved(s, kRootNode);
    const float out = root.ball.radius + root.slack + pair.maxSeparation;
    for (const Vec3& inFrame : {root.ball.center, root.ball.center + root.displacement}) {
      const Vec3 center = transpose(s.otherAxes) * inFrame;
      lower.setMin(toBullet(center - Vec3(out, out, out)));
      upper.setMax(toBullet(center + Vec3(out, out, out)));
    }
  }
  target_->take(*pair.other, lower, upper);
}

void Sweep::append(const SweptPair& pair, float from, float to, btScalar turn) {
  const int count = std::max(1, static_cast<int>(std::ceil(turn / kTurn)));
  const auto border = [&](int i) { return from + (to - from) * float(i) / float(count); };
  for (int i = 0; i < count; ++i) segments_.push_back(segment(pair, border(i), border(i + 1)));
}

Sweep::Segment Sweep::segment(const SweptPair& pair, float from, float to) const {
  const auto [begin, otherAxes] = placeAt(from);
  const auto [end, otherAxesAtEnd] = placeAt(to);
  const btTransform middle = placeAt(0.5F * (from + to)).tree;
  btVector3 center;
  btScalar radius = 0;
  pair.tree->getBoundingSphere(center, radius);
  const btScalar bow = (middle * center - (begin * center).lerp(end * center, btScalar(0.5))).length();
  return {from,
          to,
          begin,
          TreeParts(PlacedTree(pair.tree->tree(), treePose(*pair.tree, begin))),
          TreeParts(PlacedTree(pair.tree->tree(), treePose(*pair.tree, end))),
          static_cast<float>(chordBetween(begin.getBasis(), end.getBasis())),
          static_cast<float>(2 * bow),
          toMat3(otherAxes),
          toMat3(otherAxesAtEnd),
          static_cast<float>(chordBetween(otherAxes, otherAxesAtEnd)) * otherReach_};
}

// A ball's points move like its middle, apart from rotation. The ball's middle moves on an arc about the tree's middle.
Sweep::MovedNode Sweep::moved(const Segment& segment, TreeParts::Part part) {
  const Sphere ball = segment.tree.sphere(part);
  const float arm = distance(ball.center, segment.tree.sphere(kRootNode).center);
  const float height = arm * segment.chord * segment.chord / 8;
  return {ball, segment.treeAtEnd.sphere(part).center - ball.center,
          ball.radius * segment.chord + height + segment.bow + segment.otherSlack};
}

void Sweep::enter(const Segment& segment, const NodePair& pair) {
  MovedNode node = moved(segment, pair.a);
  node.ball.radius += node.slack + margin_;
  const Mat3 toOther = transpose(segment.otherAxes);
  const std::optional<float> at =
      target_->entry({toOther * node.ball.center, node.ball.radius}, pair.b, toOther * node.displacement);
  if (!at || isPastFirstHit(pair.a, segment.from + *at * (segment.to - segment.from))) return;
  heap_.push_back({*at, pair});
  std::push_heap(heap_.begin(), heap_.end());
}

// Earliest entry first, because a leaf's first meeting rules out most of the others.
void Sweep::search(const SweptPair& pair, const Segment& segment, Budget& budget) {
  heap_.clear();
  margin_ = static_cast<float>(pair.tree->getMargin());
  for (std::uint32_t i = 0; i < target_->rootCount(); ++i) enter(segment, {kRootNode, i});
  budget.forceCharge(std::uint64_t{kTestCost} * target_->rootCount());
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Candidate candidate = heap_.back();
    heap_.pop_back();
    if (isPastFirstHit(candidate.pair.a, segment.from + candidate.entry * (segment.to - segment.from))) continue;
    if (tests_ < kMaxTests && split(segment, candidate, budget)) continue;
    budget.forceCharge(kLeafCost);
    if (const std::optional<Hit> hit = hitOf(pair, segment, candidate)) note(pair, segment, candidate.pair, *hit);
  }
}

// False for a candidate that cannot be split further.
bool Sweep::split(const Segment& segment, const Candidate& candidate, Budget& budget) {
  const auto [a, b] = candidate.pair;
  const TreeParts& tree = segment.tree;
  const float radius = tree.sphere(a).radius;
  const TreeParts::Children own = tree.children(a, kCrudeInBody * tree.sphere(kRootNode).radius);
  const SweptTarget::Children below = target_->children(b, kCrudeFraction * radius);
  const bool splitsTree = own.count > 0 && (below.count == 0 || radius >= target_->radius(b));
  const std::uint32_t first = splitsTree ? own.first : below.first;
  const std::uint32_t count = splitsTree ? own.count : below.count;
  if (splitsTree && TreeParts::isTriangle(first)) addTriangleMeetings(a, count);
  for (std::uint32_t child = first; child < first + count; ++child) {
    enter(segment, splitsTree ? NodePair{child, b} : NodePair{a, child});
  }
  tests_ += count;
  budget.forceCharge(std::uint64_t{kTestCost} * count);
  return count > 0;
}

// Allocates the meetings of a leaf's triangles before they are tested.
void Sweep::addTriangleMeetings(NodeId leaf, std::uint32_t count) {
  int& known = meetingOf_[leaf];
  if (known != kNone) return;
  known = -1 - static_cast<int>(meetings_.size());
  meetings_.resize(meetings_.size() + count);
}

const Sweep::Meeting* Sweep::meetingOf(TreeParts::Part part) const {
  const int known = meetingOf_[TreeParts::nodeOf(part)];
  if (TreeParts::isTriangle(part)) return &meetings_[std::size_t(-1 - known) + TreeParts::indexOf(part)];
  return known >= 0 ? &meetings_[static_cast<std::size_t>(known)] : nullptr;
}

// A split leaf that is met as a whole after all, for lack of budget, gets a meeting that `meetingOf` does not find.
Sweep::Meeting& Sweep::makeMeeting(TreeParts::Part part) {
  if (const Meeting* const known = meetingOf(part)) return const_cast<Meeting&>(*known);
  if (meetingOf_[part] == kNone) meetingOf_[part] = static_cast<int>(meetings_.size());
  return meetings_.emplace_back();
}

// Whether the part has met something by this time.
bool Sweep::isPastFirstHit(TreeParts::Part part, float at) const {
  const Meeting* const known = meetingOf(part);
  return known && known->at <= at;
}

}  // namespace cairn::bullet
