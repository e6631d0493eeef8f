// SPDX-License-Identifier: Zlib
#include "colliders/field_collider.h"

#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>

#include <algorithm>
#include <cmath>

#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Steps from a leaf's support points down to its lowest point; each costs one query and those of its shortenings.
constexpr int kMaxDescents = 12;
// Shortenings of a step that ends where the field rises again; each costs one query.
constexpr int kMaxShortenings = 3;
// Least expected gain of a step, as a fraction of `maxSeparation_`. On flat ground the corners then stay the lowest.
constexpr float kDescentGain = 0.1F;

}  // namespace

void FieldObstacle::place(const Similarity& toShape, const DistanceField& field, float margin) {
  toShape_ = toShape;
  field_ = &field;
  margin_ = margin;
}

std::uint32_t FieldObstacle::touches(const Family& family, std::uint32_t familySize, std::uint32_t /*element*/) const {
  std::uint32_t hits = 0;
  for (std::uint32_t i = 0; i < std::min(familySize, kFamilyWidth); ++i) {
    const Vec3 center = toShape_ * Vec3(family.x[i], family.y[i], family.z[i]);
    const float radius = family.radius[i] * toShape_.scale + margin_;
    hits |= static_cast<std::uint32_t>(!field_->isFarther(center, radius)) << i;
  }
  return hits;
}

void FieldCollider::place(const PairPlacement& placement) {
  field_.take(static_cast<const btSdfCollisionShape&>(*placement.otherShape));
  tree_ = placement.tree;
  otherIndex_ = placement.otherIndex;
  margin_ = placement.treeMargin;
  maxSeparation_ = placement.maxSeparation;
  const Pose shapePose{toMat3d(placement.other.getBasis()), toVec3d(placement.other.getOrigin()), 1};
  shapeFromPair_ = relativePose(shapePose, Pose{});
  shapeFromTree_ = relativePose(shapePose, tree_.pose());
  pairFromShapeAxes_ = toSimilarity(shapePose).linear;
}

void FieldCollider::placeObstacle() {
  const float lengths =
      length(shapeFromTree_.translation) + tree_.tree().extent() * tree_.scale() + 2 * field_.extent();
  obstacle_.place(shapeFromTree_, field_, maxSeparation_ + skin_ + margin_ + kOverlapSlack * lengths);
}

void FieldCollider::start(std::vector<NodePair>& /*known*/, float skin) {
  skin_ = skin;
  placeObstacle();
  traversal_.start(tree_.tree(), tree_.scale(), obstacle_);
}

bool FieldCollider::resume() {
  placeObstacle();
  return true;
}

float FieldCollider::size(const btCollisionShape& shape) const {
  DistanceField field;
  field.take(static_cast<const btSdfCollisionShape&>(shape));
  return field.size();
}

std::optional<FieldCollider::Place> FieldCollider::placeAt(const Vec3& point) const {
  std::optional<DistanceField::Sample> sample = field_.at(shapeFromPair_ * point);
  if (!sample) return std::nullopt;
  sample->gradient = pairFromShapeAxes_ * sample->gradient;
  return Place{point, *sample};
}

void FieldCollider::appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) {
  for (const NodePair& pair : pairs) appendLeaf(pair.a, contacts);
}

void FieldCollider::appendContacts(std::span<const NodePair> pairs, std::span<float> separations,
                                   std::vector<Contact>& contacts) {
  for (std::size_t i = 0; i < pairs.size(); ++i) separations[i] = appendLeaf(pairs[i].a, contacts);
}

float FieldCollider::appendLeaf(NodeId leaf, std::vector<Contact>& contacts) const {
  const Sphere ball = tree_.sphere(leaf);
  const std::optional<Place> middle = placeAt(ball.center);
  const float apart = (middle ? middle->field.least : 0) - ball.radius - margin_;
  if (apart >= maxSeparation_) return apart;
  const std::optional<Place> place = lowest(leaf, middle);
  if (!place) return apart;
  if (tree_.isPlanar(leaf)) appendCorners(leaf, *place, contacts);
  if (tree_.isPlanar(leaf) && place->isSupport) return apart;
  appendContact(leaf, lowerExtreme(leaf, *place), -1, contacts);
  return apart;
}

// The body has a point about as far out as the leaf's ball minus the certified error, and corners that are not support
// points. They may be a leaf's radius aside, where round ground has fallen away, so the field is queried there.
FieldCollider::Place FieldCollider::lowerExtreme(NodeId leaf, const Place& place) const {
  if (!place.field.hasDirection()) return place;
  const std::optional<Place> there = placeAt(tree_.extreme(leaf, -normalized(place.field.gradient)));
  return there && canTouch(*there) && there->field.value < place.field.value ? *there : place;
}

// A planar leaf touches with its corners, because the choice of the lowest one would change with every rounding.
void FieldCollider::appendCorners(NodeId leaf, const Place& lowest, std::vector<Contact>& contacts) const {
  int index = 0;
  for (const Vec3& inTree : tree_.supportPoints(leaf)) {
    const Vec3 corner = tree_.toPair() * inTree;
    const std::optional<Place> place = corner == lowest.point ? lowest : placeAt(corner);
    if (place) appendContact(leaf, *place, index, contacts);
    ++index;
  }
}

// On the way down points may lie outside the domain, where nothing touches.
std::optional<FieldCollider::Place> FieldCollider::lowest(NodeId leaf, const std::optional<Place>& middle) const {
  std::optional<Place> place = lowestSupport(leaf, middle), touching = place;
  for (int i = 0; place && i < kMaxDescents; ++i) {
    place = descend(leaf, *place);
    if (place && (canTouch(*place) || !canTouch(*touching))) touching = place;
  }
  return touching;
}

bool FieldCollider::canTouch(const Place& place) {
  return place.field.isInDomain && place.field.hasDirection();
}

// Where the field has no direction, all points are queried.
std::optional<FieldCollider::Place> FieldCollider::lowestSupport(NodeId leaf,
                                                                 const std::optional<Place>& middle) const {
  if (middle && middle->field.hasDirection())
    if (const std::optional<Place> place = placeAt(tree_.support(leaf, -middle->field.gradient))) return place;
  std::optional<Place> lowest;
  for (const Vec3& inTree : tree_.supportPoints(leaf)) {
    const std::optional<Place> place = placeAt(tree_.toPair() * inTree);
    if (place && (!lowest || place->field.value < lowest->field.value)) lowest = place;
  }
  return lowest;
}

// Steps towards the deepest point along the gradient, as far as the field falls (Frank and Wolfe). Between the two
// slopes the field is taken for a parabola.
std::optional<FieldCollider::Place> FieldCollider::descend(NodeId leaf, const Place& from) const {
  if (!from.field.hasDirection()) return std::nullopt;
  const Vec3 downwards = -normalized(from.field.gradient);
  const Vec3 deepest = tree_.isPlanar(leaf) ? tree_.support(leaf, downwards) : tree_.extreme(leaf, downwards);
  Vec3 step = deepest - from.point;
  float fall = -dot(from.field.gradient, step);
  if (fall <= kDescentGain * maxSeparation_) return std::nullopt;
  std::optional<Place> to = placeAt(from.point + step);
  for (int i = 0; to && i < kMaxShortenings; ++i) {
    const float rise = dot(to->field.gradient, step);
    if (rise <= 0 || (i > 0 && to->field.value < from.field.value)) break;
    step = step * (fall / (fall + rise));
    fall *= fall / (fall + rise);
    to = placeAt(from.point + step);
    if (to) to->isSupport = false;
  }
  if (!to || to->field.value >= from.field.value) return std::nullopt;
  return to;
}

// Points outside the field's domain touch nothing.
void FieldCollider::appendContact(NodeId leaf, const Place& place, int pointIndex,
                                  std::vector<Contact>& contacts) const {
  if (!canTouch(place)) return;
  Contact contact;
  contact.normal = normalized(place.field.gradient);
  contact.separation = place.field.height() - margin_;
  if (contact.separation >= maxSeparation_) return;
  contact.pair = {leaf, 0};
  contact.position = place.point - contact.normal * (margin_ + 0.5F * contact.separation);
  contact.id = {static_cast<int>(tree_.tree().level(leaf)), static_cast<int>(leaf), pointIndex, otherIndex_};
  contacts.push_back(contact);
}

// Where the field has no value, the contact holds nothing.
Contact FieldCollider::boundingContact(const NodePair& pair) {
  const Sphere ball = tree_.sphere(pair.a);
  Contact contact;
  contact.ofSpheres = true;
  contact.pair = pair;
  contact.normal = Vec3(0, 0, 1);
  contact.position = ball.center;
  contact.separation = maxSeparation_ + ball.radius;
  contact.id = {static_cast<int>(tree_.tree().level(pair.a)), static_cast<int>(pair.a), -1, otherIndex_};
  const std::optional<Place> place = placeAt(ball.center);
  if (!place || !place->field.hasDirection()) return contact;
  contact.normal = normalized(place->field.gradient);
  contact.separation = place->field.value - ball.radius - margin_;
  if (place->field.value <= 0) contact.certainDepth = tree_.innerRadius(pair.a);
  contact.position = ball.center - contact.normal * (ball.radius + margin_ + 0.5F * contact.separation);
  return contact;
}

bool FieldCollider::seeOtherSides(const Place& middle, const Place& lowest) {
  const Vec3 &ofMiddle = middle.field.gradient, &ofLowest = lowest.field.gradient;
  return dot(ofMiddle, ofLowest) < kCoarseCosine * length(ofMiddle) * length(ofLowest);
}

// For each child of the root: its lowest support point.
std::uint32_t FieldCollider::appendCoarse(std::vector<Contact>& contacts) {
  const NodeId first = tree_.tree().childFamily(kRootNode) * kFamilyWidth;
  const std::uint32_t count = tree_.tree().childCount(kRootNode);
  const std::size_t before = contacts.size();
  for (NodeId child = first; child < first + count; ++child) {
    const Sphere ball = tree_.sphere(child);
    const std::optional<Place> middle = placeAt(ball.center);
    if (middle && middle->field.least - ball.radius - margin_ >= maxSeparation_) continue;
    const std::optional<Place> place = lowestSupport(child, middle);
    if (place && !(middle && seeOtherSides(*middle, *place))) appendContact(child, *place, -1, contacts);
  }
  for (Contact& contact : std::span(contacts).subspan(before)) contact.ofSpheres = true;
  return count;
}

std::uint32_t FieldCollider::appendRootContacts(std::vector<Contact>& contacts) {
  if (placeAt(tree_.sphere(kRootNode).center)) return Collider::appendRootContacts(contacts);
  return 1;
}

}  // namespace cairn::bullet
