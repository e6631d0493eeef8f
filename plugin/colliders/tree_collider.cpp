// SPDX-License-Identifier: Zlib
#include "colliders/tree_collider.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "cairn/bullet/sphere_tree_shape.h"
#include "colliders/feature_ids.h"
#include "kernel/contact_tuning.h"
#include "placement/tree_pose.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

namespace {
// Families of the larger tree opened for root contacts; this bounds the work of a pair without budget.
constexpr int kMaxRootSplits = 8;
}  // namespace

void TreeCollider::reset() {
  Collider::reset();
  kernelMemory_.forget();
}

void TreeCollider::shrinkToFit() {
  traversal_.shrinkToFit();
  kernelMemory_.shrinkToFit();
}

void TreeCollider::place(const PairPlacement& placement) {
  const SphereTreeShape& shape = *asSphereTree(placement.otherShape);
  a_ = placement.tree;
  b_ = placedTree(shape, placement.other, placement.smallerSize);
  margins_ = placement.treeMargin + static_cast<float>(shape.getMargin());
  maxSeparation_ = placement.maxSeparation;
  contactDistance_ = placement.contactDistance();
  const Sphere rootA = a_.sphere(kRootNode), rootB = b_.sphere(kRootNode);
  isOfLikeSize_ = !isMuchLarger(rootA, rootB) && !isMuchLarger(rootB, rootA);
}

float TreeCollider::size(const btCollisionShape& shape) const {
  return static_cast<float>(asSphereTree(&shape)->size());
}

void TreeCollider::start(std::vector<NodePair>& /*known*/, float skin) {
  traversal_.start(a_.tree(), b_.tree(), a_.pose(), b_.pose(), maxSeparation_ + margins_ + skin);
}

bool TreeCollider::resume() {
  traversal_.movePoses(a_.pose(), b_.pose());
  return true;
}

Vec3 TreeCollider::centerLine(const Sphere& a, const Sphere& b) const {
  const Vec3 line = a.center - b.center;
  if (line != Vec3()) return unitVector(line);
  // Spheres with one centre have no direction, so the whole bodies give it.
  const Vec3 bodies = a_.sphere(kRootNode).center - b_.sphere(kRootNode).center;
  return bodies != Vec3() ? unitVector(bodies) : Vec3(0, 0, 1);
}

bool TreeCollider::preferPlanes(Contact& contact) const {
  const bool isPlanarA = a_.isPlanar(contact.pair.a), isPlanarB = b_.isPlanar(contact.pair.b);
  if (!isPlanarA && !isPlanarB) return true;
  const auto offer = [&](const Vec3& normal) {
    Contact other = contact;
    other.normal = normal;
    const bool isNear = measure(other, maxSeparation_);
    if (other.separation > contact.separation) contact = other;
    return isNear;
  };
  if (isPlanarA && !offer(-a_.facing(contact.pair.a))) return false;
  if (isPlanarB && !offer(b_.facing(contact.pair.b))) return false;
  return !a_.facesAlong(contact.pair.a, contact.normal) && !b_.facesAlong(contact.pair.b, -contact.normal);
}

void TreeCollider::expect(std::span<const Vec3> normals) {
  expectedCount_ = 0;
  for (const Vec3& normal : normals)
    if (lengthSq(normal) > 0) expected_[expectedCount_++] = normal;
}

bool TreeCollider::areFaceted(const NodePair& pair) const {
  return a_.isFaceted(pair.a) && b_.isFaceted(pair.b);
}

float TreeCollider::separation(const NodePair& pair, const Vec3& along) const {
  return dot(along, a_.support(pair.a, -along) - b_.support(pair.b, along)) - margins_;
}

// A direction that separates the two regions by `maxSeparation_` proves that they do not touch. If they are about as
// near as possible along a normal, and not beside each other, no other direction is needed.
TreeCollider::Expected TreeCollider::touchAsExpected(Contact& contact, const Sphere& a, const Sphere& b) const {
  if (!areFaceted(contact.pair)) return Expected::nothing;
  for (const Vec3& normal : std::span(expected_).first(expectedCount_)) {
    contact.normal = normal;
    if (!measure(contact, maxSeparation_)) return Expected::apart;
    if (contact.separation < -maxSeparation_) continue;
    const Vec3 line = a.center - b.center, beside = line - normal * dot(line, normal);
    if (beside == Vec3()) return Expected::touching;
    const float apart = separation(contact.pair, unitVector(beside));
    if (apart < maxSeparation_) return Expected::touching;
    contact.separation = apart;
    return Expected::apart;
  }
  return Expected::nothing;
}

bool TreeCollider::measure(Contact& contact, float atMost) const {
  const RegionSeparation measured =
      measureSeparation(a_.regions(), b_.regions(), contact.pair, contact.normal, {margins_, atMost, maxSeparation_});
  contact.separation = measured.separation;
  if (measured.isNear) contact.position = measured.position;
  return measured.isNear;
}

bool TreeCollider::touch(Contact& contact, float atMost) const {
  const Sphere a = a_.sphere(contact.pair.a);
  const Sphere b = b_.sphere(contact.pair.b);
  const Expected expected = expectedCount_ > 0 ? touchAsExpected(contact, a, b) : Expected::nothing;
  if (expected == Expected::apart) return false;
  if (expected == Expected::nothing) {
    contact.normal = centerLine(a, b);
    if (!measure(contact, atMost) || !preferPlanes(contact)) return false;
  }
  setId(contact);
  return true;
}

void TreeCollider::setId(Contact& contact) const {
  contact.id = {static_cast<int>(a_.tree().level(contact.pair.a)), static_cast<int>(contact.pair.a),
                static_cast<int>(b_.tree().level(contact.pair.b)), static_cast<int>(contact.pair.b)};
}

void TreeCollider::appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) {
  appendMeasured(pairs, maxSeparation_, {}, contacts);
}

void TreeCollider::appendContacts(std::span<const NodePair> pairs, std::span<float> separations,
                                  std::vector<Contact>& contacts) {
  appendMeasured(pairs, std::numeric_limits<float>::infinity(), separations, contacts);
}

void TreeCollider::appendMeasured(std::span<const NodePair> pairs, float atMost, std::span<float> separations,
                                  std::vector<Contact>& contacts) const {
  RegionSeparations measured;
  while (!pairs.empty()) {
    const std::span<const NodePair> some = pairs.first(std::min<std::size_t>(pairs.size(), RegionSeparations::kSize));
    measureSeparations(a_.regions(), b_.regions(), some, {margins_, atMost, maxSeparation_}, measured);
    const std::uint32_t alone = measured.blurredPairs | expectedOf(some);
    const std::span<float> reported = separations.first(std::min(separations.size(), some.size()));
    std::copy_n(measured.separation, reported.size(), reported.begin());
    for (std::uint32_t lanes = measured.nearPairs | alone; lanes != 0; lanes &= lanes - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(lanes));
      Contact contact;
      contact.pair = some[i];
      const bool touches = (alone >> i & 1U) != 0 ? touch(contact, atMost) : touchAsMeasured(contact, measured, i);
      if (!reported.empty()) reported[i] = contact.separation;
      if (touches) contacts.push_back(contact);
    }
    pairs = pairs.subspan(some.size());
    separations = separations.subspan(reported.size());
  }
}

std::uint32_t TreeCollider::expectedOf(std::span<const NodePair> pairs) const {
  if (expectedCount_ == 0) return 0;
  std::uint32_t lanes = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) lanes |= static_cast<std::uint32_t>(areFaceted(pairs[i])) << i;
  return lanes;
}

bool TreeCollider::touchAsMeasured(Contact& contact, const RegionSeparations& measured, std::uint32_t lane) const {
  contact.normal = measured.normal(lane);
  contact.separation = measured.separation[lane];
  contact.position = measured.position(lane);
  if (!preferPlanes(contact)) return false;
  setId(contact);
  return true;
}

Contact TreeCollider::boundingContact(const NodePair& pair) {
  const Sphere a = a_.sphere(pair.a);
  const Sphere b = b_.sphere(pair.b);
  Contact contact;
  contact.ofSpheres = true;
  contact.pair = pair;
  contact.normal = centerLine(a, b);
  const float apart = distance(a.center, b.center);
  contact.separation = apart - a.radius - b.radius - margins_;
  const float innerA = a_.innerRadius(pair.a), innerB = b_.innerRadius(pair.b);
  if (innerA > 0 && innerB > 0)
    contact.certainDepth = std::max(0.0F, innerA + innerB - apart - kOverlapSlack * (a.radius + b.radius + apart));
  contact.position = b.center + contact.normal * (b.radius + 0.5F * contact.separation);
  setId(contact);
  return contact;
}

bool TreeCollider::isMuchLarger(const Sphere& large, const Sphere& small) const {
  return large.radius > kMaxSizeRatio * small.radius;
}

// Replaces the largest sphere by its children that still overlap, until none is much larger or the work limit is
// reached. The remaining spheres cover all that may touch.
std::uint32_t TreeCollider::appendRootContacts(std::vector<Contact>& contacts) {
  const Sphere rootA = a_.sphere(kRootNode), rootB = b_.sphere(kRootNode);
  const bool splitsA = isMuchLarger(rootA, rootB);
  if (!splitsA && !isMuchLarger(rootB, rootA)) return Collider::appendRootContacts(contacts);
  const PlacedTree& large = splitsA ? a_ : b_;
  const Sphere& small = splitsA ? rootB : rootA;
  const auto nodeOf = [&](const Contact& c) { return splitsA ? c.pair.a : c.pair.b; };
  const auto radiusOf = [&](const Contact& c) {
    return large.tree().isLeaf(nodeOf(c)) ? 0 : large.sphere(nodeOf(c)).radius;
  };
  std::uint32_t tests = 1;
  rootContacts_.assign(1, boundingContact({kRootNode, kRootNode}));
  for (int split = 0; split < kMaxRootSplits && !rootContacts_.empty(); ++split) {
    const auto largest = std::ranges::max_element(rootContacts_, {}, radiusOf);
    if (radiusOf(*largest) <= small.radius) break;
    const NodeId node = nodeOf(*largest);
    rootContacts_.erase(largest);
    const NodeId first = large.tree().childFamily(node) * kFamilyWidth;
    for (NodeId child = first; child < first + large.tree().childCount(node); ++child, ++tests) {
      const Contact contact = boundingContact(splitsA ? NodePair{child, kRootNode} : NodePair{kRootNode, child});
      if (contact.separation < maxSeparation_) rootContacts_.push_back(contact);
    }
  }
  contacts.insert(contacts.end(), rootContacts_.begin(), rootContacts_.end());
  return tests;
}

std::optional<float> TreeCollider::appendOfMesh(const MeshQuery& question, std::vector<Contact>& contacts) {
  if (question.finest != Finest::triangles || traversal_.leafPairs().empty()) return {};
  return appendOfKernel(question, contacts);
}

// Without leaf pairs the meshes are not queried.
std::optional<std::uint64_t> TreeCollider::expectedMeshCost(const RelativePlacement& placement) const {
  if (traversal_.done() && traversal_.leafPairs().empty()) return 0;
  return kernelMemory_.expectedCost(placement);
}

// Contacts of meshes have no leaves, so the nearest leaves are looked up.
NodePair TreeCollider::leavesOf(const Contact& contact) const {
  if (contact.pair != NodePair{kRootNode, kRootNode}) return contact.pair;
  return {a_.leafAt(contact.position), b_.leafAt(contact.position)};
}

std::optional<float> TreeCollider::appendOfKernel(const MeshQuery& question, std::vector<Contact>& contacts) {
  const float thinner = std::min(a_.thickness(), b_.thickness());
  const ContactLimits limits = ContactLimits::of(contactDistance_, maxSeparation_, thinner, margins_);
  const std::optional<ContactKernel::Answer> answer =
      question.kernel.run(SurfacePair::of(a_, b_), limits, kernelMemory_, question.placement, question.budget);
  if (!answer) return {};
  for (const FeatureContact& found : answer->contacts) contacts.push_back(contactOf(found, featureIdsOf(found)));
  return answer->minSeparation;
}

// A region that does not face the normal, but is about as near along it, lies on a border; its
// neighbour gives the contact. If it is far deeper than along a direction it does face, the contact belongs to another
// face.
Vec3 TreeCollider::alignNormals(std::span<Contact> cluster, std::span<const Vec3> lasts,
                                std::vector<Contact>& outliers) {
  const Vec3 normal = planarNormal_.find(a_, b_, margins_, cluster, lasts);
  if (lengthSq(normal) == 0) return {};
  for (Contact& contact : cluster) {
    if (contact.ofSpheres) continue;
    const Contact before = contact;
    const bool isMeasured = isSameNormal(contact.normal, normal);
    contact.normal = normal;
    const bool isNear = isMeasured || measure(contact, maxSeparation_);
    if (isNear && a_.faces(contact.pair.a, -normal) && b_.faces(contact.pair.b, normal)) continue;
    const bool isDeep = isNear && contact.separation < -maxSeparation_;
    if (isDeep && planarNormal_.isFartherAlongOther(a_, b_, margins_, before, contact.separation + maxSeparation_))
      outliers.push_back(before);
    contact.separation = maxSeparation_;
  }
  return normal;
}

}  // namespace cairn::bullet
