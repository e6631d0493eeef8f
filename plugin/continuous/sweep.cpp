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

// Radians that a tree may turn against the other within a segment: the points of a leaf are then up to a fifth of its
// radius beside its straight way.
constexpr btScalar kTurn = btScalar(0.2);
// Moving a sphere and testing it once; measuring a leaf pair moves two.
constexpr std::uint32_t kTestCost = kSphereUpdateCost + kOverlapTestCost;
constexpr std::uint32_t kLeafCost = 2 * kSphereUpdateCost + kOverlapTestCost;
// Of the way: what closes by less along a direction passes by.
constexpr float kPassingFraction = 1e-4F;
// What is left of a unit line beside the way, to make a direction of.
constexpr float kLeastBeside = 0.1F;
// Of a node's radius: so deep it may be already and still be in front, as what slides is.
constexpr float kSunkFraction = 0.1F;
// By then what had sunk in is out, or else is pressed in: where it stood long ago says nothing of that.
constexpr int kMostSlowSteps = 30;
// Two walls of a corner, after its floor.
constexpr int kDeflections = 2;

// A leaf whose certified error is more than this part of the other side's radius may say too little of where its
// surface is to be met as a whole.
constexpr float kCrudeFraction = 0.25F;
// The same of the moved tree's own leaves, as a part of its radius: one contact for each would not hold it.
constexpr float kCrudeInBody = 0.05F;
constexpr int kNone = std::numeric_limits<int>::min();

btScalar turnBetween(const btTransform& x, const btTransform& y) {
  return x.getRotation().angleShortestPath(y.getRotation());
}

}  // namespace

const std::vector<Contact>& Sweep::run(const SweptPair& pair, Budget& budget) {
  const SphereTreeShape* const other = asSphereTree(pair.other);
  if (!other || other->size() >= pair.tree->size()) {
    sweep(pair, budget);
    return contacts_;
  }
  sweep({other, pair.tree, pair.otherCourse, pair.treeCourse, pair.origin, pair.reach, pair.isFast}, budget);
  for (Contact& contact : contacts_) swapSides(contact);
  return contacts_;
}

void Sweep::swapSides(Contact& contact) {
  contact.normal = -contact.normal;
  contact.apart = -contact.apart;
  contact.treeIsLarger = true;
  std::swap(contact.pair.a, contact.pair.b);
  contact.id = {contact.id.otherPart, contact.id.otherIndex, contact.id.treePart, contact.id.treeIndex};
}

void Sweep::sweep(const SweptPair& pair, Budget& budget) {
  contacts_.clear();
  tests_ = 0;
  follow(pair, true, budget);
  bool isSunk = false;
  for (const Meeting& m : meetings_) {
    if (m.isContact) contacts_.push_back(m.contact);
    isSunk = isSunk || (m.isContact && m.at < 0);
  }
  if (pair.isFast) deflect(pair, budget);
  slowSteps_ = pair.isFast ? 0 : slowSteps_ + 1;
  if (isSunk && slowSteps_ < kMostSlowSteps) return;
  anchor_.reset();
  if (pair.isFast) anchor_ = placeAt(pair, 0);
}

// What is stopped by a floor goes on along it, and may run into a wall of the same body within the step; then along
// both into a third.
void Sweep::deflect(SweptPair pair, Budget& budget) {
  for (int turn = 0; turn < kDeflections; ++turn) {
    const auto earlier = [](const Meeting& x, const Meeting& y) {
      return (x.isContact ? x.at : kNotMet) < (y.isContact ? y.at : kNotMet);
    };
    const auto first = std::ranges::min_element(meetings_, earlier);
    if (first == meetings_.end() || !first->isContact) return;
    const Vec3 normal = first->contact.normal;
    pair.treeCourse = pair.treeCourse.along(toBullet(normal), pair.otherCourse);
    follow(pair, false, budget);
    for (const Meeting& m : meetings_)
      if (m.isContact && dot(m.contact.normal, normal) < kSameWayCosine) contacts_.push_back(m.contact);
  }
}

void Sweep::follow(const SweptPair& pair, bool fromAnchor, Budget& budget) {
  meetings_.clear();
  cut(pair, fromAnchor);
  if (target_->rootCount() == 0) return;
  meetingOf_.assign(segments_.front().tree.tree().traversalNodes().size(), kNone);
  for (const Segment& s : segments_) {
    // What it came to on the way from the anchor and is in front of still, it may run into now.
    if (s.from == 0)
      for (Meeting& m : meetings_)
        if (!m.isContact) m.at = kNotMet;
    search(pair, s, budget);
  }
}

// The tree in the other's frame.
btTransform Sweep::placeAt(const SweptPair& pair, float part) const {
  const auto at = [&](btScalar p) { return pair.otherCourse.at(p).inverseTimes(pair.treeCourse.at(p)); };
  if (part >= 0) return at(btScalar(part));
  const btTransform now = at(0);
  const btScalar back = -btScalar(part);
  return btTransform(now.getRotation().slerp(anchor_->getRotation(), back),
                     now.getOrigin().lerp(anchor_->getOrigin(), back));
}

// Also asks the target for all that is near the way.
void Sweep::cut(const SweptPair& pair, bool fromAnchor) {
  segments_.clear();
  if (anchor_ && fromAnchor) append(pair, -1, 0, turnBetween(*anchor_, placeAt(pair, 0)));
  if (pair.isFast) append(pair, 0, 1, pair.treeCourse.turn() + pair.otherCourse.turn());
  btVector3 lower(SIMD_INFINITY, SIMD_INFINITY, SIMD_INFINITY), upper = -lower;
  for (const Segment& s : segments_) {
    const MovedNode root = moved(s, kRootNode);
    const float out = root.ball.radius + root.slack + pair.reach;
    for (const Vec3& center : {root.ball.center, root.ball.center + root.way}) {
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
  const btTransform begin = placeAt(pair, from), middle = placeAt(pair, 0.5F * (from + to)), end = placeAt(pair, to);
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
          static_cast<float>(2 * bow)};
}

// A ball's points move as its middle does but for what turning adds; its middle moves on an arc about the tree's.
Sweep::MovedNode Sweep::moved(const Segment& segment, TreeParts::Part part) {
  const Sphere ball = segment.tree.sphere(part);
  const float arm = distance(ball.center, segment.tree.sphere(kRootNode).center);
  const float height = arm * segment.chord * segment.chord / 8;
  return {ball, segment.treeAtEnd.sphere(part).center - ball.center,
          ball.radius * segment.chord + height + segment.bow};
}

void Sweep::enter(const Segment& segment, const NodePair& pair) {
  MovedNode node = moved(segment, pair.a);
  node.ball.radius += node.slack + margin_;
  const std::optional<float> at = target_->entry(node.ball, pair.b, node.way);
  if (!at || isSettled(pair.a, segment.from + *at * (segment.to - segment.from))) return;
  heap_.push_back({*at, pair});
  std::push_heap(heap_.begin(), heap_.end());
}

// Earliest first, so that what a leaf runs into first rules out most of the rest.
void Sweep::search(const SweptPair& pair, const Segment& segment, Budget& budget) {
  heap_.clear();
  margin_ = static_cast<float>(pair.tree->getMargin());
  for (std::uint32_t i = 0; i < target_->rootCount(); ++i) enter(segment, {kRootNode, i});
  budget.chargeAnyway(std::uint64_t{kTestCost} * target_->rootCount());
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Candidate candidate = heap_.back();
    heap_.pop_back();
    if (isSettled(candidate.pair.a, segment.from + candidate.entry * (segment.to - segment.from))) continue;
    if (tests_ < kMaxTests && split(segment, candidate, budget)) continue;
    budget.chargeAnyway(kLeafCost);
    if (const std::optional<Hit> hit = hitOf(pair, segment, candidate)) note(pair, segment, candidate.pair, *hit);
  }
}

// False for what cannot be split any more.
bool Sweep::split(const Segment& segment, const Candidate& candidate, Budget& budget) {
  const auto [a, b] = candidate.pair;
  const TreeParts& tree = segment.tree;
  const float radius = tree.sphere(a).radius;
  const TreeParts::Children own = tree.children(a, kCrudeInBody * tree.sphere(kRootNode).radius);
  const SweptTarget::Children below = target_->children(b, kCrudeFraction * radius);
  const bool splitsTree = own.count > 0 && (below.count == 0 || radius >= target_->radius(b));
  const std::uint32_t first = splitsTree ? own.first : below.first;
  const std::uint32_t count = splitsTree ? own.count : below.count;
  if (splitsTree && TreeParts::isTriangle(first)) makeMeetingsBelow(a, count);
  for (std::uint32_t child = first; child < first + count; ++child) {
    enter(segment, splitsTree ? NodePair{child, b} : NodePair{a, child});
  }
  tests_ += count;
  budget.chargeAnyway(std::uint64_t{kTestCost} * count);
  return count > 0;
}

// Two regions that come together within a segment.
struct Sweep::Approach {
  const Segment& segment;
  const SweptTarget& target;
  NodePair nodes;
  MovedNode node;
  float entry;    // part of the segment at which they are near
  float margins;  // of both
  float sunk;     // so deep they still count as apart

  float gap(const Vec3& normal) const { return gapOf(segment.tree, normal); }
  float gapAtEnd(const Vec3& normal) const { return gapOf(segment.treeAtEnd, normal); }
  float closing(const Vec3& normal) const { return -dot(normal, node.way); }
  bool passes(const Vec3& normal) const { return closing(normal) <= kPassingFraction * length(node.way); }
  bool areApart(const Vec3& normal, float at) const { return gap(normal) - closing(normal) * at > -sunk; }
  Hit hit(const Vec3& normal) const {
    const float least = gap(normal) - node.slack;
    return {std::clamp(least / closing(normal), entry, 1.0F), normal, closing(normal)};
  }

 private:
  float gapOf(const TreeParts& tree, const Vec3& normal) const {
    return dot(normal, tree.support(nodes.a, -normal) - target.support(nodes.b, normal)) - margins;
  }
};

// Returns how many of them are the other side's; those come first.
std::size_t Sweep::collectNormals(const Approach& approach) {
  normals_.clear();
  const Vec3& way = approach.node.way;
  target_->appendNormals(approach.nodes.b, approach.node.ball.center + way * approach.entry, normals_);
  const std::size_t ofOther = normals_.all().size();
  approach.segment.tree.appendFaces(approach.nodes.a, normals_);
  if (normals_.all().empty()) return ofOther;
  const Vec3 along = normalized(way), line = normals_.all().front(), beside = line - along * dot(along, line);
  if (const float norm = length(beside); norm > kLeastBeside) normals_.add(beside / norm, false);
  return ofOther;
}

// Along each direction the regions stay apart for a while; what counts is the one along which they do so for longest.
// Nothing if that is to the end of the segment, or if they are in contact already.
std::optional<Sweep::Hit> Sweep::hitOf(const SweptPair& pair, const Segment& segment, const Candidate& candidate) {
  const MovedNode node = moved(segment, candidate.pair.a);
  if (lengthSq(node.way) == 0) return std::nullopt;
  const Approach approach{segment,
                          *target_,
                          candidate.pair,
                          node,
                          candidate.entry,
                          target_->margin() + margin_,
                          std::max(pair.reach, kSunkFraction * node.ball.radius)};
  const std::size_t ofOther = collectNormals(approach);
  std::optional<Hit> latest;
  for (const Vec3& normal : normals_.all()) {
    if (!approach.areApart(normal, candidate.entry)) continue;
    if (approach.passes(normal) || approach.gap(normal) - node.slack + approach.sunk >= approach.closing(normal))
      return std::nullopt;
    // The slack is more than what turning brings nearer: at the segment's end it is known.
    if (approach.gapAtEnd(normal) > -approach.sunk) return std::nullopt;
    const Hit hit = approach.hit(normal);
    if (!latest || hit.at > latest->at) latest = hit;
  }
  return latest ? std::optional(flattest(approach, *latest, ofOther)) : std::nullopt;
}

// Where surfaces of several faces go on flatly, an edge between two of them is no obstacle: of the faces along whose
// normals the regions are still as good as apart by then, the other side's if it has any, the one along which they
// close least.
Sweep::Hit Sweep::flattest(const Approach& approach, Hit latest, std::size_t ofOther) const {
  bool hasOtherFaces = false;
  for (std::size_t i = 0; i < ofOther; ++i) hasOtherFaces = hasOtherFaces || normals_.isFace(i);
  const float at = latest.at;
  for (std::size_t i = 0; i < (hasOtherFaces ? ofOther : normals_.all().size()); ++i) {
    const Vec3& normal = normals_.all()[i];
    if (!normals_.isFace(i) || approach.passes(normal) || approach.closing(normal) >= latest.closing) continue;
    if (approach.areApart(normal, at)) latest = approach.hit(normal);
  }
  return latest;
}

// The smaller region knows where: on a flat one any point may be the extreme one.
Sweep::Points Sweep::pointsOf(const Segment& segment, const NodePair& nodes, const Hit& hit) const {
  const Vec3 onTree = segment.tree.support(nodes.a, -hit.normal), onOther = target_->support(nodes.b, hit.normal);
  const Vec3 way = moved(segment, nodes.a).way * hit.at;
  const Vec3 apart = hit.normal * dot(hit.normal, onTree + way - onOther);
  if (segment.tree.sphere(nodes.a).radius <= target_->radius(nodes.b)) return {onTree, onTree + way - apart};
  return {onOther - way + apart, onOther};
}

// Where the two regions are now, with the plane that they reach then.
void Sweep::note(const SweptPair& pair, const Segment& segment, const NodePair& nodes, const Hit& hit) {
  const float length = segment.to - segment.from, at = segment.from + hit.at * length;
  if (isSettled(nodes.a, at)) return;
  const auto inPair = [&](btTransform pose) {
    pose.getOrigin() -= pair.origin;
    return pose;
  };
  const btTransform tree = inPair(pair.treeCourse.at(0)), other = inPair(pair.otherCourse.at(0));
  Contact contact;
  contact.isAhead = contact.ofSpheres = true;
  const NodeId leaf = TreeParts::nodeOf(nodes.a);
  contact.pair = {leaf, nodes.b};
  contact.normal = toVec3(other.getBasis() * toBullet(hit.normal));
  const Points points = pointsOf(segment, nodes, hit);
  const Vec3 onTree = toVec3(tree * segment.treeInOther.invXform(toBullet(points.onTree)));
  const Vec3 onOther = toVec3(other * toBullet(points.onOther));
  contact.apart = onTree - onOther - contact.normal * (target_->margin() + margin_);
  const float gap = dot(contact.normal, contact.apart);
  const bool isSunk = segment.from < 0;
  if (!isSunk && gap < 0) contact.apart -= contact.normal * gap;  // it has turned in between
  contact.position = onTree - contact.normal * dot(contact.normal, contact.apart);
  contact.gap = -(1 - at) * hit.closing / length;
  contact.id = {static_cast<int>(segment.tree.tree().level(leaf)), static_cast<int>(leaf), -1, pair.otherIndex};
  target_->name(nodes.b, contact);

  const bool isLeftToOthers = segment.from == 0 && gap <= pair.reach;
  makeMeeting(nodes.a) = {at, isSunk ? gap < 0 : !isLeftToOthers, contact};
}

// Before anything is asked about a leaf's triangles.
void Sweep::makeMeetingsBelow(NodeId leaf, std::uint32_t count) {
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

// A leaf that is met as a whole after all, because there is no time for more, is not known by that.
Sweep::Meeting& Sweep::makeMeeting(TreeParts::Part part) {
  if (const Meeting* const known = meetingOf(part)) return const_cast<Meeting&>(*known);
  if (meetingOf_[part] == kNone) meetingOf_[part] = static_cast<int>(meetings_.size());
  return meetings_.emplace_back();
}

// Whether the part has met something by then.
bool Sweep::isSettled(TreeParts::Part part, float at) const {
  const Meeting* const known = meetingOf(part);
  return known && known->at <= at;
}

}  // namespace cairn::bullet
