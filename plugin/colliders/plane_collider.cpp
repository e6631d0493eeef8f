// SPDX-License-Identifier: Zlib
#include "colliders/plane_collider.h"

#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {
// Marks a vertex in no near leaf; no node has this id.
constexpr NodeId kNoLeaf = ~NodeId{0};
}  // namespace

void PlaneObstacle::place(const Vec3& normal, float offset, float margin) {
  normal_ = normal;
  limit_ = offset + margin;
}

std::uint32_t PlaneObstacle::touches(const Family& family, std::uint32_t familySize, std::uint32_t /*element*/) const {
  std::uint32_t hits = 0;
  const std::uint32_t size = familySize < kFamilyWidth ? familySize : kFamilyWidth;
  for (std::uint32_t i = 0; i < size; ++i) {
    const float height = normal_.x * family.x[i] + normal_.y * family.y[i] + normal_.z * family.z[i];
    hits |= static_cast<std::uint32_t>(height - family.radius[i] <= limit_) << i;
  }
  return hits;
}

void PlaneCollider::place(const PairPlacement& placement) {
  const auto& shape = static_cast<const btStaticPlaneShape&>(*placement.otherShape);
  tree_ = placement.tree;
  otherIndex_ = placement.otherIndex;
  margin_ = placement.treeMargin;
  maxSeparation_ = placement.maxSeparation;
  isQuery_ = placement.maxSeparation > placement.speculativeDistance;
  const btVector3 normal = placement.other.getBasis() * shape.getPlaneNormal();
  normal_ = toVec3(normal);
  offset_ = static_cast<float>(shape.getPlaneConstant() + normal.dot(placement.other.getOrigin()));
}

void PlaneCollider::placeObstacle() {
  const float unit = 1 / tree_.scale();
  const float below = (offset_ - dot(normal_, tree_.toPair().translation)) * unit;
  const float lengths = std::abs(below) + 2 * tree_.tree().extent() + std::abs(offset_) * unit;
  obstacle_.place(tree_.axesFromPair() * normal_, below,
                  (maxSeparation_ + skin_ + margin_) * unit + kOverlapSlack * lengths);
}

void PlaneCollider::reset() {
  Collider::reset();
  areFound_ = false;
}

void PlaneCollider::start(std::vector<NodePair>& /*known*/, float skin) {
  areFound_ = false;
  if (hasFewVertices()) {
    leafOf_.reserve(tree_.tree().vertices().size());
    nearVertices_.reserve(tree_.tree().vertices().size());
  }
  skin_ = skin;
  placeObstacle();
  traversal_.start(tree_.tree(), tree_.scale(), obstacle_);
}

bool PlaneCollider::resume() {
  placeObstacle();
  return true;
}

// A planar leaf touches with its corners, because the choice of the extreme one would change with every rounding.
void PlaneCollider::appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) {
  for (const NodePair& pair : pairs) {
    if (!tree_.isPlanar(pair.a)) {
      appendContact(pair, tree_.extreme(pair.a, -normal_), -1, contacts);
      continue;
    }
    int index = 0;
    for (const Vec3& point : tree_.supportPoints(pair.a))
      appendContact(pair, tree_.toPair() * point, index++, contacts);
  }
}

// Treats the regions of the root's children as leaves.
std::uint32_t PlaneCollider::appendCoarse(std::vector<Contact>& contacts) {
  const NodeId first = tree_.tree().childFamily(kRootNode) * kFamilyWidth;
  const std::uint32_t count = tree_.tree().childCount(kRootNode);
  std::array<NodePair, kFamilyWidth> pairs;
  for (std::uint32_t i = 0; i < count; ++i) pairs[i] = {first + i, kRootNode};
  const std::size_t before = contacts.size();
  appendContacts(std::span(pairs).first(count), contacts);
  for (Contact& contact : std::span(contacts).subspan(before)) contact.ofSpheres = true;
  return count;
}

bool PlaneCollider::hasFewVertices() const {
  return tree_.tree().vertices().size() <= kMaxVertices;
}

// A vertex belongs to the first near leaf whose ball holds it.
void PlaneCollider::findVertices() {
  const SphereTree& tree = tree_.tree();
  areFound_ = true;
  nearVertices_.clear();
  leafOf_.assign(tree.vertices().size(), kNoLeaf);
  for (const NodePair& pair : traversal_.leafPairs())
    for (const std::uint32_t triangle : tree.regionTriangles(pair.a))
      for (const std::uint32_t v : tree.triangles()[triangle]) {
        const Sphere ball = tree.sphere(pair.a);
        if (leafOf_[v] != kNoLeaf || distance(tree.vertices()[v], ball.center) > ball.radius) continue;
        leafOf_[v] = pair.a;
        nearVertices_.push_back({v, pair.a});
      }
}

// A mesh's lowest points are vertices, in whatever leaf, and a query that looks beyond the contact distance needs them.
// Meshes of many vertices keep their leaves otherwise: a round body rolls on balls, and its facets would brake it.
std::optional<float> PlaneCollider::appendOfMesh(const MeshQuery& question, std::vector<Contact>& contacts) {
  if (traversal_.leafPairs().empty()) return std::nullopt;
  const bool isDistanceWanted = question.finest == Finest::triangles && isQuery_;
  if (!hasFewVertices() && !isDistanceWanted) return std::nullopt;
  if (!areFound_) findVertices();
  const std::uint64_t cost = kSphereUpdateCost * nearVertices_.size();
  if (!hasFewVertices() && !question.budget.charge(cost)) return std::nullopt;
  if (hasFewVertices()) question.budget.forceCharge(cost);
  const std::size_t before = contacts.size();
  float lowest = maxSeparation_ + skin_;  // the traversal did not look farther
  for (const NearVertex& near : nearVertices_) {
    const Vec3 vertex = tree_.toPair() * tree_.tree().vertices()[near.vertex];
    lowest = std::min(lowest, dot(normal_, vertex) - offset_ - margin_);
    appendContact({near.leaf, kRootNode}, vertex, static_cast<int>(near.vertex), contacts);
  }
  for (Contact& contact : std::span(contacts).subspan(before)) contact.isExact = true;
  return lowest;
}

void PlaneCollider::appendContact(const NodePair& pair, const Vec3& onTree, int pointIndex,
                                  std::vector<Contact>& contacts) const {
  Contact contact;
  contact.separation = dot(normal_, onTree) - offset_ - margin_;
  if (contact.separation >= maxSeparation_) return;
  contact.pair = pair;
  contact.normal = normal_;
  contact.position = onTree - normal_ * (margin_ + 0.5F * contact.separation);
  contact.id = {static_cast<int>(tree_.tree().level(pair.a)), static_cast<int>(pair.a), pointIndex, otherIndex_};
  contacts.push_back(contact);
}

Contact PlaneCollider::boundingContact(const NodePair& pair) {
  const Sphere s = tree_.sphere(pair.a);
  Contact contact;
  contact.ofSpheres = true;
  contact.pair = pair;
  contact.normal = normal_;
  const float height = dot(normal_, s.center) - offset_;
  contact.separation = height - s.radius - margin_;
  if (const float inner = tree_.innerRadius(pair.a); inner > 0)
    contact.certainDepth = std::max(0.0F, inner - height - kOverlapSlack * (s.radius + std::abs(offset_)));
  contact.position = s.center - normal_ * (s.radius + margin_ + 0.5F * contact.separation);
  contact.id = {static_cast<int>(tree_.tree().level(pair.a)), static_cast<int>(pair.a), -1, otherIndex_};
  return contact;
}

}  // namespace cairn::bullet
