// SPDX-License-Identifier: Zlib
#include "colliders/triangle_collider.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "colliders/ground_limits.h"
#include "contacts/normal_clusters.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {
// Steps of motion to gather ahead after the tree has left the gathered triangles.
constexpr btScalar kStepsAhead = 4;
// How much larger than the tree (by boxes, margins included) a shape may be and still stand on the tree's faces.
constexpr float kAlike = 1.05F;
}  // namespace

float TriangleCollider::size(const btCollisionShape& shape) const {
  btVector3 lower, upper;
  shape.getAabb(btTransform::getIdentity(), lower, upper);
  const auto diagonal = static_cast<float>((upper - lower).length());
  // A foreign shape may report an infinite or NaN box.
  return std::isfinite(diagonal) ? diagonal : std::numeric_limits<float>::infinity();
}

void TriangleCollider::reset() {
  Collider::reset();
  outran_ = false;
  sides_.reset();
  onFaces_.reset();
  ground_.reset();
}

std::optional<float> TriangleCollider::appendOfMesh(const MeshQuery& question, std::vector<Contact>& contacts) {
  // A leaf's side depends on where leaves were in earlier steps. So answers of leaves and of meshes must not alternate
  // from step to step.
  if (question.finest != Finest::triangles || question.mayBeInterrupted) return {};
  const auto& shape = static_cast<const btConcaveShape&>(*placement_.otherShape);
  const MeshGround::Near near{shape, soup_, inPair_};
  if (!ground_.watch(placement_, near) || traversal_.leafPairs().empty()) return {};
  return ground_.append(question, placement_, near, contacts);
}

// Contacts of meshes have no leaves, so the nearest leaf is looked up.
NodePair TriangleCollider::leavesOf(const Contact& contact) const {
  if (contact.pair != NodePair{kRootNode, kRootNode} || !contact.isExact) return contact.pair;
  return {placement_.tree.leafAt(contact.position), MeshGround::inSoup(soup_, contact)};
}

void TriangleCollider::place(const PairPlacement& placement) {
  placement_ = placement;
  sides_.beginStep(placement);
  placement.treeShape->getAabb(placement.other.inverse() * placement.treeBody, treeLower_, treeUpper_);
  const btScalar maxSeparation = btScalar(placement.maxSeparation);
  treeLower_ -= btVector3(maxSeparation, maxSeparation, maxSeparation);
  treeUpper_ += btVector3(maxSeparation, maxSeparation, maxSeparation);
}

void TriangleCollider::start(std::vector<NodePair>& known, float /*skin*/) {
  oldSources_.clear();
  for (const NodePair& pair : known) oldSources_.push_back(soup_.triangles()[pair.b]);
  gather();
  rename(known);
  placeTriangles();
  sides_.beginTraversal();
  traversal_.start(placement_.tree.tree(), placement_.tree.scale(), obstacle_);
}

bool TriangleCollider::resume() {
  if (!soup_.covers(treeLower_, treeUpper_)) {
    outran_ = true;
    return false;
  }
  placeTriangles();
  return true;
}

void TriangleCollider::gather() {
  const btScalar ahead = outran_ ? kStepsAhead * btScalar(placement_.travel) : 0;
  outran_ = false;
  const btVector3 grow(ahead, ahead, ahead);
  soup_.gather(static_cast<const btConcaveShape&>(*placement_.otherShape), treeLower_ - grow, treeUpper_ + grow);
}

void TriangleCollider::rename(std::vector<NodePair>& known) const {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const int element = soup_.find(oldSources_[i]);
    if (element >= 0) known[kept++] = {known[i].a, static_cast<std::uint32_t>(element)};
  }
  known.resize(kept);
}

void TriangleCollider::placeTriangles() {
  const PlacedTree& tree = placement_.tree;
  const float unit = 1 / tree.scale();
  const float margin = (placement_.maxSeparation + placement_.treeMargin) * unit;
  // The triangles of interest are near the tree, so the tree's own extent bounds rounding.
  const float lengths = 4 * (tree.tree().extent() + margin);
  obstacle_.clear(margin + kOverlapSlack * lengths);
  inPair_.clear();
  for (const TriangleSoup::Source& source : soup_.triangles()) {
    const Triangle t{toVec3(placement_.other * source.corners[0]), toVec3(placement_.other * source.corners[1]),
                     toVec3(placement_.other * source.corners[2])};
    inPair_.push_back(t);
    obstacle_.add({tree.toTree(t.a), tree.toTree(t.b), tree.toTree(t.c)});
  }
}

void TriangleCollider::appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) {
  const std::size_t first = contacts.size();
  if (placement_.speculativeDistance > 0 && placement_.speculativeDistance < placement_.maxSeparation)
    measureQuery(pairs, contacts);
  else
    measure(pairs, placement_, contacts);
  for (std::size_t i = first; i < contacts.size(); ++i) {
    const TriangleSoup::Source& source = soup_.triangles()[contacts[i].pair.b];
    const NodeId leaf = contacts[i].pair.a;
    contacts[i].id = {static_cast<int>(placement_.tree.tree().level(leaf)), static_cast<int>(leaf), source.part,
                      source.index};
  }
}

void TriangleCollider::measure(std::span<const NodePair> pairs, const PairPlacement& placement,
                               std::vector<Contact>& contacts) {
  divide(pairs);
  contacts_.append(placement, inPair_, others_, traversal_.done(), sides_, contacts);
  onFaces_.append(placement, size(*placement.otherShape), inPair_, ofFaces_, traversal_.done(), contacts);
}

// Surface within the contact distance decides to which face a point belongs. A query that looks farther would let most
// of the body decide. So touching pairs are measured as in a step, and only contacts farther apart come from the wider
// search.
void TriangleCollider::measureQuery(std::span<const NodePair> pairs, std::vector<Contact>& contacts) {
  const TriangleSides sidesBefore = sides_;
  const TrianglesOnFaces facesBefore = onFaces_;
  const std::size_t first = contacts.size();
  measure(pairs, placement_, contacts);
  const auto touches = [&](const Contact& c) { return c.separation < placement_.speculativeDistance; };
  contacts.erase(std::remove_if(contacts.begin() + static_cast<std::ptrdiff_t>(first), contacts.end(), touches),
                 contacts.end());
  sides_ = sidesBefore;
  onFaces_ = facesBefore;
  near_.clear();
  std::ranges::copy_if(pairs, std::back_inserter(near_), [&](const NodePair& pair) { return isNear(pair); });
  PairPlacement placement = placement_;
  placement.maxSeparation = placement_.speculativeDistance;
  measure(near_, placement, contacts);
}

bool TriangleCollider::isNear(const NodePair& pair) const {
  const Sphere ball = placement_.tree.sphere(pair.a);
  const float within = ball.radius + placement_.treeMargin + placement_.speculativeDistance;
  return lengthSq(ball.center - nearestOnTriangle(inPair_[pair.b], ball.center).point) < within * within;
}

// A shape no larger than the tree stands on the faces of the tree's flat leaves.
void TriangleCollider::divide(std::span<const NodePair> pairs) {
  others_.clear();
  ofFaces_.clear();
  const bool isSmaller = size(*placement_.otherShape) <= kAlike * float(placement_.treeShape->size());
  for (const NodePair& pair : pairs)
    (isSmaller && TrianglesOnFaces::isFor(placement_.tree, pair.a) ? ofFaces_ : others_).push_back(pair);
  std::ranges::sort(ofFaces_, {}, [](const NodePair& pair) { return std::pair(pair.a, pair.b); });
}

Contact TriangleCollider::boundingContact(const NodePair& pair) {
  const TriangleTouch touch = touchOf(placement_.tree, inPair_[pair.b], pair);
  const auto side = static_cast<float>(sides_.ofBall(placement_.tree, touch));
  const TriangleSoup::Source& source = soup_.triangles()[pair.b];
  Contact contact;
  contact.ofSpheres = true;
  contact.pair = pair;
  contact.normal = side * (lengthSq(touch.line) > 0 ? touch.line : anyNormalOf(inPair_[pair.b]));
  contact.separation = side * touch.distance - placement_.tree.sphere(pair.a).radius - placement_.treeMargin;
  contact.position = touch.nearest + contact.normal * (0.5F * contact.separation);
  contact.id = {static_cast<int>(placement_.tree.tree().level(pair.a)), static_cast<int>(pair.a), source.part,
                source.index};
  return contact;
}

std::uint32_t TriangleCollider::appendRootContacts(std::vector<Contact>& contacts) {
  const Sphere root = placement_.tree.sphere(kRootNode);
  const auto onTriangle = [&](const Contact& c) { return c.onTree() - c.normal * c.separation; };
  rootContacts_.clear();
  for (std::uint32_t i = 0; i < inPair_.size(); ++i) rootContacts_.push_back(boundingContact({kRootNode, i}));
  std::uint32_t found = 0;
  for (; found < kMaxRootContacts && !rootContacts_.empty(); ++found) {
    // The first of equals, because the order of the triangles is the shape's own.
    Contact nearest = *std::ranges::min_element(rootContacts_, {}, &Contact::separation);
    nearest.isRootContact = true;
    sides_.noteBall(touchOf(placement_.tree, inPair_[nearest.pair.b], nearest.pair), nearest.normal);
    contacts.push_back(nearest);
    std::erase_if(rootContacts_, [&](const Contact& c) {
      const bool isCovered = dot(nearest.normal, onTriangle(c) - onTriangle(nearest)) <= kCoveredFraction * root.radius;
      return isCovered || dot(nearest.normal, c.normal) > kSameMotionCosine;
    });
  }
  return found;
}

}  // namespace cairn::bullet
