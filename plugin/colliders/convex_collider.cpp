// SPDX-License-Identifier: Zlib
#include "colliders/convex_collider.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "colliders/feature_ids.h"
#include "colliders/inner_edges.h"
#include "contacts/cut_face.h"
#include "contacts/face_limits.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Fraction of `maxSeparation_` by which a plane must separate better to be preferred.
constexpr float kPlaneGain = 0.1F;
// Steps by which a contact point that hangs over the shape's edge moves towards the place of touch; each halves the
// way.
constexpr int kMaxPulls = 3;
// Fraction of the shape's size at which a leaf's radius counts as large: the shape may then stand in the middle of the
// leaf.
constexpr float kLargeLeaf = 0.25F;

// In the shape's own frame, margin included.
Box ownBox(const btCollisionShape& shape) {
  btVector3 lower, upper;
  shape.getAabb(btTransform::getIdentity(), lower, upper);
  return {toVec3(lower), toVec3(upper)};
}

}  // namespace

void ConvexObstacle::place(const Similarity& toShape, const Vec3& boxCenter, const Vec3& boxHalfExtents, float margin) {
  toShape_ = toShape;
  center_ = boxCenter;
  halfExtents_ = boxHalfExtents;
  margin_ = margin;
}

std::uint32_t ConvexObstacle::touches(const Family& family, std::uint32_t familySize, std::uint32_t /*element*/) const {
  std::uint32_t hits = 0;
  for (std::uint32_t i = 0; i < std::min(familySize, kFamilyWidth); ++i) {
    const Vec3 p = toShape_ * Vec3(family.x[i], family.y[i], family.z[i]) - center_;
    const float dx = std::max(std::abs(p.x) - halfExtents_.x, 0.0F);
    const float dy = std::max(std::abs(p.y) - halfExtents_.y, 0.0F);
    const float dz = std::max(std::abs(p.z) - halfExtents_.z, 0.0F);
    const float maxSeparation = family.radius[i] * toShape_.scale + margin_;
    hits |= static_cast<std::uint32_t>(dx * dx + dy * dy + dz * dz <= maxSeparation * maxSeparation) << i;
  }
  return hits;
}

void ConvexCollider::place(const PairPlacement& placement) {
  const auto& shape = static_cast<const btConvexShape&>(*placement.otherShape);
  surface_.setShape(shape);
  tree_ = placement.tree;
  otherIndex_ = placement.otherIndex;
  margin_ = placement.treeMargin;
  maxSeparation_ = placement.maxSeparation;
  contactDistance_ = placement.contactDistance();
  planes_.reserve(kMaxPlanes);
  planes_.clear();

  box_ = ownBox(shape);
  const Vec3 boxMiddle = box_.middle(), halfExtents = (box_.upper - box_.lower) * 0.5F;
  size_ = 2 * length(halfExtents);
  isSmall_ = size_ <= 2 * tree_.tree().extent() * tree_.scale();
  const Pose shapePose{toMat3d(placement.other.getBasis()), toVec3d(placement.other.getOrigin()), 1};
  shapeFromPair_ = relativePose(shapePose, Pose{});
  pairFromShapeAxes_ = toSimilarity(shapePose).linear;
  shapeOrigin_ = Vec3(shapePose.translation);
  boxMiddle_ = pairFromShapeAxes_ * boxMiddle + shapeOrigin_;
  const Similarity shapeFromTree = relativePose(shapePose, tree_.pose());
  const float lengths = length(shapeFromTree.translation) + tree_.tree().extent() * tree_.scale() + length(halfExtents);
  obstacle_.place(shapeFromTree, boxMiddle, halfExtents, maxSeparation_ + margin_ + kOverlapSlack * lengths);
}

float ConvexCollider::size(const btCollisionShape& shape) const {
  const Box box = ownBox(shape);
  return length(box.upper - box.lower);
}

// Corners inside the box may have moved as well.
bool ConvexCollider::isUnchanged(const btCollisionShape& other) const {
  const auto& shape = static_cast<const btConvexShape&>(other);
  const Box box = ownBox(shape);
  return box.lower == box_.lower && box.upper == box_.upper && surface_.isStillOf(shape);
}

void ConvexCollider::start(std::vector<NodePair>& /*known*/, float /*skin*/) {
  traversal_.start(tree_.tree(), tree_.scale(), obstacle_);
}

NearestPoint ConvexCollider::inPair(const NearestPoint& inShape) const {
  return {pairFromShapeAxes_ * inShape.point + shapeOrigin_, pairFromShapeAxes_ * inShape.normal, inShape.distance};
}

NearestPoint ConvexCollider::nearest(const Vec3& pointInPair) {
  return inPair(surface_.nearest(shapeFromPair_ * pointInPair));
}

Vec3 ConvexCollider::support(const Vec3& direction) const {
  return pairFromShapeAxes_ * surface_.support(transpose(pairFromShapeAxes_) * direction) + shapeOrigin_;
}

std::optional<float> ConvexCollider::appendOfMesh(const MeshQuery& question, std::vector<Contact>& contacts) {
  if (question.finest != Finest::triangles || question.mayBeInterrupted || traversal_.leafPairs().empty()) return {};
  const ContactLimits limits =
      ContactLimits::of(contactDistance_, maxSeparation_, tree_.thickness(), margin_ + surface_.margin());
  const PlacedSurface surface = PlacedSurface::of(tree_.contactMesh(), tree_.pose());
  const std::optional<ContactKernel::Answer> answer =
      question.kernel.run(surface, *this, limits, margin_, question.budget);
  if (!answer) return {};
  for (const FeatureContact& found : answer->contacts) {
    const ContactId id = featureIdsOf(found);
    contacts.push_back(contactOf(found, {id.treePart, id.treeIndex, static_cast<int>(found.featureB), otherIndex_}));
  }
  return answer->minSeparation;
}

// Contacts of meshes have no leaves, so the nearest leaf is looked up.
NodePair ConvexCollider::leavesOf(const Contact& contact) const {
  if (contact.pair != NodePair{kRootNode, kRootNode}) return contact.pair;
  return {tree_.leafAt(contact.position), 0};
}

bool ConvexCollider::isCertainlySeparated(const Sphere& sphere) const {
  const float maxSeparation = sphere.radius + margin_ + maxSeparation_;
  return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    return dot(plane.normal, sphere.center) - plane.offset > maxSeparation;
  });
}

void ConvexCollider::appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) {
  const std::size_t first = contacts.size();
  for (const NodePair& pair : pairs) {
    const Sphere sphere = tree_.sphere(pair.a);
    if (!isCertainlySeparated(sphere)) appendLeaf(pair.a, sphere, contacts);
  }
  if (isSmall_ && contacts.size() > first + 1) measureInnerEdges(first, contacts);
}

void ConvexCollider::measureInnerEdges(std::size_t first, std::vector<Contact>& contacts) {
  InnerEdges edges(tree_, maxSeparation_);
  for (const Contact& contact : std::span(contacts).subspan(first)) edges.note(contact);
  const std::size_t end = contacts.size();
  for (std::size_t i = first; i < end; ++i)
    if (const Vec3* const normal = edges.normalInstead(contacts[i]))
      appendAlong(*normal, Contact(contacts[i]), contacts);
  const auto begin = contacts.begin() + static_cast<std::ptrdiff_t>(first),
             old = contacts.begin() + static_cast<std::ptrdiff_t>(end);
  const auto isInner = [&](const Contact& contact) { return edges.normalInstead(contact) != nullptr; };
  contacts.erase(std::remove_if(begin, old, isInner), old);
}

// Uses those of the leaf's own points that lie over the shape.
void ConvexCollider::appendAlong(const Vec3& normal, const Contact& inner, std::vector<Contact>& contacts) {
  const NodeId leaf = inner.pair.a;
  const Vec3 onShape = pairFromShapeAxes_ * surface_.support(transpose(pairFromShapeAxes_) * normal) + shapeOrigin_;
  Touch touch = touchAlong(leaf, {normal, dot(normal, onShape)});
  touch.point = inner.onTree();
  if (!tree_.isPlanar(leaf)) {
    const Vec3 where = pulledOntoShape(touch.point, touch.point, touch.height);
    if (isOnShape(where, touch.height)) appendContact(leaf, touch, touch.point, -1, contacts);
    return;
  }
  int index = 0;
  for (const Vec3& point : tree_.supportPoints(leaf)) {
    const Vec3 onTree = tree_.toPair() * point;
    if (isOnShape(pulledOntoShape(onTree, touch.point, touch.height), touch.height))
      appendContact(leaf, touch, onTree, index, contacts);
    ++index;
  }
}

void ConvexCollider::appendLeaf(NodeId leaf, const Sphere& sphere, std::vector<Contact>& contacts) {
  const NearestPoint center = nearest(sphere.center);
  const float apart = center.distance - sphere.radius - margin_ - maxSeparation_;
  if (apart > 0) {
    // GJK's planes support the shape up to its accuracy, far below the lengths they are compared with.
    if (planes_.size() < kMaxPlanes) planes_.push_back({center.normal, dot(center.normal, center.point)});
    return;
  }
  Touch touch = touchAlong(leaf, {center.normal, dot(center.normal, center.point)});
  if (touch.height - margin_ < maxSeparation_) improve(leaf, touch);
  if (touch.height - margin_ >= maxSeparation_) return;
  if (sphere.radius > kLargeLeaf * size_ && tree_.tree().regionTriangles(leaf).size() <= kMaxTriangles) {
    if (!appendCommon(leaf, touch, contacts)) appendContact(leaf, touch, touch.point, -1, contacts);
    return;
  }
  if (!tree_.isPlanar(leaf)) {
    appendContact(leaf, touch, tree_.extreme(leaf, -touch.plane.normal), -1, contacts);
    return;
  }
  // A planar leaf touches with its corners, because the choice of the extreme one would change with every rounding.
  int index = 0;
  for (const Vec3& point : tree_.supportPoints(leaf))
    appendContact(leaf, touch, tree_.toPair() * point, index++, contacts);
}

// Tests for each child of the root its lowest point, along the shape's normal at the child's middle. By GJK this would
// take longer than the contacts it replaces.
std::uint32_t ConvexCollider::appendCoarse(std::vector<Contact>& contacts) {
  if (!surface_.isClosedForm()) return 0;
  const NodeId first = tree_.tree().childFamily(kRootNode) * kFamilyWidth;
  const std::uint32_t count = tree_.tree().childCount(kRootNode);
  for (NodeId child = first; child < first + count; ++child) {
    const Sphere sphere = tree_.sphere(child);
    const NearestPoint middle = nearest(sphere.center);
    if (middle.distance - sphere.radius - margin_ >= maxSeparation_) continue;
    const Vec3 lowest = tree_.support(child, -middle.normal);
    const NearestPoint onShape = nearest(lowest);
    const float separation = onShape.distance - margin_;
    if (separation >= maxSeparation_ || dot(onShape.normal, middle.normal) < kCoarseCosine) continue;
    append(child, onShape.normal, lowest - onShape.normal * (margin_ + 0.5F * separation), separation, -1, contacts);
    contacts.back().ofSpheres = true;
  }
  return count;
}

ConvexCollider::Touch ConvexCollider::touchAlong(NodeId leaf, const Plane& plane) const {
  const Vec3 lowest = tree_.extreme(leaf, -plane.normal);
  return {plane, dot(plane.normal, lowest) - plane.offset, lowest};
}

// The plane nearest to the leaf's centre lies outside a round shape everywhere else, so that coarse leaves would float.
// Every plane that supports the shape is a true bound, so the best of several is taken. If the leaf's lowest point is
// as near as the plane says, no plane is better.
void ConvexCollider::improve(NodeId leaf, Touch& touch) {
  if (nearest(touch.point).distance <= touch.height + kPlaneGain * maxSeparation_) return;
  offerFaces(leaf, touch);
  if (touch.height - margin_ >= maxSeparation_) return;
  const std::optional<NearestPoint> found = nearestToLeaf(leaf);
  if (!found) return;
  const NearestPoint onShape = inPair(*found);
  offer(leaf, {onShape.normal, dot(onShape.normal, onShape.point)}, touch);
  touch.point = onShape.point + onShape.normal * onShape.distance;
}

std::optional<NearestPoint> ConvexCollider::nearestToLeaf(NodeId leaf) {
  std::array<Vec3, ConvexSurface::kMaxHullPoints> inShape;
  std::size_t count = 0;
  const auto add = [&](const Vec3& inTree) { inShape[count++] = shapeFromPair_ * (tree_.toPair() * inTree); };
  for (const Vec3& point : tree_.supportPoints(leaf)) add(point);
  for (const std::uint32_t v : tree_.tree().regionCorners(leaf)) add(tree_.tree().vertices()[v]);
  return surface_.nearestToHull(std::span(inShape).first(count));
}

// Planes that are better by less than a tenth of `maxSeparation_` would only make the choice flicker.
void ConvexCollider::offer(NodeId leaf, const Plane& plane, Touch& touch) const {
  const Touch other = touchAlong(leaf, plane);
  if (other.height > touch.height + kPlaneGain * maxSeparation_) touch = other;
}

void ConvexCollider::offerFaces(NodeId leaf, Touch& touch) const {
  const Mat3 pairFromTreeAxes = transpose(tree_.axesFromPair());
  const Mat3 shapeFromPairAxes = transpose(pairFromShapeAxes_);
  for (const Vec3& outwards : tree_.tree().faceNormals(leaf)) {
    const Vec3 normal = -(pairFromTreeAxes * outwards);
    const Vec3 onShape = pairFromShapeAxes_ * surface_.support(shapeFromPairAxes * normal) + shapeOrigin_;
    offer(leaf, {normal, dot(normal, onShape)}, touch);
  }
}

// Moves a contact point that hangs over the shape's edge towards the place where the leaf touches.
Vec3 ConvexCollider::pulledOntoShape(const Vec3& onTree, const Vec3& anchor, float height) {
  Vec3 where = onTree;
  for (int i = 0; i < kMaxPulls && nearest(where).distance > std::max(height, 0.0F) + maxSeparation_; ++i)
    where = 0.5F * (where + anchor);
  return where;
}

bool ConvexCollider::isOnShape(const Vec3& onTree, float height) {
  return nearest(onTree).distance <= std::max(height, 0.0F) + maxSeparation_;
}

bool ConvexCollider::appendCommon(NodeId leaf, const Touch& touch, std::vector<Contact>& contacts) {
  const SphereTree& tree = tree_.tree();
  const std::size_t before = contacts.size();
  const Vec3& normal = touch.plane.normal;
  const Mat3 shapeFromPairAxes = transpose(pairFromShapeAxes_);
  facing_.look(shapeFromPairAxes * normal, size_, [&](const Vec3& direction) { return surface_.support(direction); });
  std::array<Vec3, FacingCorners::kMaxCorners> face;
  const std::size_t corners = facing_.corners().size();
  for (std::size_t i = 0; i < corners; ++i) face[i] = pairFromShapeAxes_ * facing_.corners()[i] + shapeOrigin_;
  for (const std::uint32_t index : tree.regionTriangles(leaf)) {
    const auto& [i, j, k] = tree.triangles()[index];
    const auto corner = [&](std::uint32_t v) { return tree_.toPair() * tree.vertices()[v]; };
    appendOnTriangle(leaf, normal, {corner(i), corner(j), corner(k)}, std::span(face).first(corners), contacts);
  }
  int index = 0;
  for (const Vec3& point : tree_.supportPoints(leaf)) {
    const Vec3 onTree = tree_.toPair() * point;
    const float height = dot(normal, onTree) - touch.plane.offset;
    if (height - margin_ < maxSeparation_ && isOnShape(onTree, height))
      appendContact(leaf, touch, onTree, index, contacts);
    ++index;
  }
  // Corners that are not support points may lie lower. Within a tenth of `maxSeparation_` the lowest would flicker, so
  // such corners are ignored. Only corners count, not the leaf's ball: surface that the ball certifies beyond them
  // belongs to other leaves. It may be the wall of a slot in which the shape stands.
  const Vec3 lowest = tree_.farthestCorner(leaf, -normal);
  const float height = dot(normal, lowest) - touch.plane.offset;
  const auto isAsLow = [&](const Contact& c) { return c.separation <= height - margin_ + kPlaneGain * maxSeparation_; };
  if (isOnShape(lowest, height) && std::ranges::none_of(std::span(contacts).subspan(before), isAsLow))
    appendContact(leaf, touch, lowest, -1, contacts);
  return contacts.size() > before;
}

// Cuts the face by planes through the triangle's sides along the normal; the rest lies over the triangle.
void ConvexCollider::appendOnTriangle(NodeId leaf, const Vec3& normal, const Triangle& triangle,
                                      std::span<const Vec3> face, std::vector<Contact>& contacts) const {
  const Vec3 outwards = triangle.normal();
  const float facing = -dot(outwards, normal);
  if (facing < kSameFaceCosine) return;
  CutFace<3> common(face);
  const float seam = kSeam * tree_.sphere(leaf).radius;
  const std::array<Vec3, 3> corner{triangle.a, triangle.b, triangle.c};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 inwards = cross(corner[(i + 1) % 3] - corner[i], normal);
    common.cut(inwards, dot(inwards, corner[i]) - seam * length(inwards));
  }
  // Point numbers after those of the leaf's own points.
  int index = kMaxSupportPoints;
  for (const Vec3& onShape : common.points()) {
    const float separation = dot(outwards, onShape - triangle.a) / facing - margin_;
    append(leaf, normal, onShape + normal * (0.5F * separation), separation, index++, contacts);
  }
}

void ConvexCollider::appendContact(NodeId leaf, const Touch& touch, const Vec3& onTree, int pointIndex,
                                   std::vector<Contact>& contacts) {
  const Plane& plane = touch.plane;
  const float height = dot(plane.normal, onTree) - plane.offset;
  const float separation = height - margin_;
  if (separation >= maxSeparation_) return;
  const Vec3 where = pulledOntoShape(onTree, touch.point, height);
  const Vec3 position = where + plane.normal * (plane.offset - dot(plane.normal, where) + 0.5F * separation);
  append(leaf, plane.normal, position, separation, pointIndex, contacts);
}

void ConvexCollider::append(NodeId leaf, const Vec3& normal, const Vec3& position, float separation, int pointIndex,
                            std::vector<Contact>& contacts) const {
  if (separation >= maxSeparation_) return;
  Contact contact;
  contact.pair = {leaf, 0};
  contact.normal = normal;
  contact.separation = separation;
  contact.position = position;
  contact.id = {static_cast<int>(tree_.tree().level(leaf)), static_cast<int>(leaf), pointIndex, otherIndex_};
  contacts.push_back(contact);
}

Contact ConvexCollider::boundingContact(const NodePair& pair) {
  const Sphere sphere = tree_.sphere(pair.a);
  const NearestPoint center = nearest(sphere.center);
  Contact contact;
  contact.ofSpheres = true;
  contact.pair = pair;
  contact.normal = center.normal;
  contact.separation = center.distance - sphere.radius - margin_;
  contact.position = center.point + contact.normal * (0.5F * contact.separation);
  contact.id = {static_cast<int>(tree_.tree().level(pair.a)), static_cast<int>(pair.a), -1, otherIndex_};
  return contact;
}

}  // namespace cairn::bullet
