// SPDX-License-Identifier: Zlib
#include "colliders/terrain_collider.h"

#include <algorithm>
#include <cmath>

#include "cairn/bullet/sphere_tree_shape.h"
#include "colliders/ground_limits.h"
#include "contacts/normal_clusters.h"
#include "placement/bullet_math.h"
#include "terrain/terrain_balls.h"

namespace cairn::bullet {

namespace {

// Fraction of a ball's radius: nearer to its centre, the direction to a border is only rounding.
constexpr float kNoDirectionFraction = 0.001F;
// Cosine of the hundredth of a radian within which faces count as one plane.
constexpr float kSamePlaneCosine = 0.99995F;

Pose inverse(const Pose& pose) {
  const Mat3d back = transpose(pose.rotation);
  return {back, back * -pose.translation, 1};
}

}  // namespace

void GroundObstacle::place(const TerrainLattice& lattice, const Pose& terrainFromTree, double margin) {
  lattice_ = &lattice;
  terrainFromTree_ = terrainFromTree;
  margin_ = margin;
}

std::uint32_t GroundObstacle::touches(const Family& family, std::uint32_t familySize, std::uint32_t /*element*/) const {
  std::uint32_t hits = 0;
  for (std::uint32_t i = 0; i < std::min(familySize, kFamilyWidth); ++i) {
    const Vec3d center(double(family.x[i]), double(family.y[i]), double(family.z[i]));
    if (!isFinite(center)) continue;
    const double radius = double(family.radius[i]) * terrainFromTree_.scale + margin_;
    hits |= static_cast<std::uint32_t>(touchesGround(*lattice_, terrainFromTree_ * center, radius)) << i;
  }
  return hits;
}

void TerrainCollider::place(const PairPlacement& placement) {
  placement_ = placement;
  lattice_ = &static_cast<const TerrainShape&>(*placement.otherShape).lattice();
  pairFromTerrain_ = {toMat3d(placement.other.getBasis()), toVec3d(placement.other.getOrigin()), 1};
  terrainFromPair_ = inverse(pairFromTerrain_);
}

void TerrainCollider::placeObstacle() {
  const PlacedTree& tree = placement_.tree;
  const Pose& pose = tree.pose();
  const float margin = placement_.maxSeparation + placement_.treeMargin;
  // The ground of interest is near the tree, so the tree's own extent bounds rounding.
  const float lengths = 4 * (tree.tree().extent() * tree.scale() + margin);
  obstacle_.place(*lattice_,
                  {terrainFromPair_.rotation * pose.rotation, terrainFromPair_ * pose.translation, pose.scale},
                  double(margin + kOverlapSlack * lengths));
}

void TerrainCollider::start(std::vector<NodePair>& /*known*/, float /*skin*/) {
  placeObstacle();
  traversal_.start(placement_.tree.tree(), placement_.tree.scale(), obstacle_);
}

bool TerrainCollider::resume() {
  placeObstacle();
  return true;
}

void TerrainCollider::forgetFrom(std::size_t count) {
  inPair_.resize(count);
  indices_.resize(count);
  sideOf_.resize(count);
  pairs_.resize(count);
}

Triangle TerrainCollider::toPair(const TerrainLattice::Corners& t) const {
  const auto corner = [&](int i) { return Vec3(pairFromTerrain_ * toVec3d(t.at[i])); };
  return {corner(0), corner(1), corner(2)};
}

// Appends the triangles near a node's sphere to the working memory, unless the sphere is certainly out of reach.
void TerrainCollider::gather(NodeId node) {
  const Sphere ball = placement_.tree.sphere(node);
  const Vec3d center = terrainFromPair_ * Vec3d(ball.center);
  const auto radius = double(ball.radius + placement_.treeMargin + placement_.maxSeparation);
  const GroundBelow ground = groundBelow(*lattice_, center, radius);
  isComplete_ = ground.factor > 0;
  if (ground.leastDistance() > radius) return;
  forEachTriangleNear(*lattice_, center, radius, ground.isInside(), [&](const TerrainLattice::Corners& t, int index) {
    pairs_.push_back({node, static_cast<std::uint32_t>(inPair_.size())});
    inPair_.push_back(toPair(t));
    last_ = t;
    indices_.push_back(index);
    sideOf_.push_back(ground.isInside() ? -1 : 1);
  });
}

// Measures the gathered triangles, node by node and nearest first, with their sides. The upper face always counts,
// whichever side of a triangle's plane a centre is on. A touch whose way out leads downwards gets no side: it lies
// behind others, or on the ground's border. A touch outside the sphere gets none either, because nothing inside the
// sphere touches there.
std::span<TriangleTouch> TerrainCollider::measure() {
  const std::span<TriangleTouch> touches = contacts_.measure(placement_, inPair_, pairs_);
  const Vec3 up(pairFromTerrain_.rotation * Vec3d(0, 0, 1));
  const float own = placement_.treeMargin + placement_.maxSeparation;
  sides_.clear();
  for (TriangleTouch& touch : touches) {
    const int side = sideOf_[touch.pair.b];
    touch.face = inPair_[touch.pair.b].normal() * static_cast<float>(side);
    if (touch.distance < kNoDirectionFraction * placement_.tree.sphere(touch.pair.a).radius) touch.line = touch.face;
    const bool isFar = side > 0 && touch.distance > placement_.tree.sphere(touch.pair.a).radius + own;
    sides_.push_back(isFar || static_cast<float>(side) * dot(touch.line, up) < 0 ? 0 : side);
  }
  return touches;
}

void TerrainCollider::appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) {
  forgetFrom(0);
  const std::size_t first = contacts.size();
  for (const NodePair& pair : pairs) {
    const std::size_t firstNear = inPair_.size();
    gather(pair.a);
    if (inPair_.size() > firstNear && placement_.tree.isPlanar(pair.a)) appendCorners(pair.a, firstNear, contacts);
  }
  const std::size_t corners = contacts.size();
  measure();
  contacts_.appendMeasured(placement_, inPair_, sides_, contacts);
  for (std::size_t i = corners; i < contacts.size(); ++i) {
    const NodePair pair = contacts[i].pair;
    contacts[i].id = idOf(pair.a, 0, indices_[pair.b]);
    contacts[i].pair.b = 0;
  }
  dropCovered(contacts, first, corners);
}

// A planar leaf touches with its corners, because the choice of the extreme one would change with every rounding. Over
// a single triangle there is nothing else to touch.
void TerrainCollider::appendCorners(NodeId leaf, std::size_t firstNear, std::vector<Contact>& contacts) {
  const PlacedTree& tree = placement_.tree;
  const bool isSingle = isComplete_ && inPair_.size() == firstNear + 1;
  TerrainLattice::Corners over = last_;
  Vec3d normal = normalized(over.normal());
  int number = 0, index = indices_[firstNear];
  for (const Vec3& point : tree.supportPoints(leaf)) {
    ++number;
    const Vec3 corner = tree.toPair() * point;
    const Vec3d at = terrainFromPair_ * Vec3d(corner);
    if (!isSingle) {
      if (!lattice_->cornersOver(at.x, at.y, over, index)) continue;
      normal = normalized(over.normal());
    }
    Contact contact;
    contact.separation = static_cast<float>(dot(normal, at - toVec3d(over.at[0]))) - placement_.treeMargin;
    if (contact.separation >= placement_.maxSeparation) continue;
    contact.normal = Vec3(pairFromTerrain_.rotation * normal);
    if (tree.facesAlong(leaf, contact.normal)) continue;
    contact.pair = {leaf, 0};
    contact.position = corner - contact.normal * (placement_.treeMargin + 0.5F * contact.separation);
    contact.id = idOf(leaf, number, index);
    contacts.push_back(contact);
  }
  if (isSingle) forgetFrom(firstNear);
}

// Drops contacts that repeat what a planar leaf's corners say.
void TerrainCollider::dropCovered(std::vector<Contact>& contacts, std::size_t first, std::size_t corners) {
  const std::span<const Contact> ofCorners(contacts.data() + first, corners - first);
  const auto isCovered = [&](const Contact& c) {
    return std::ranges::any_of(ofCorners, [&](const Contact& corner) {
      return corner.pair.a == c.pair.a && dot(corner.normal, c.normal) > kSamePlaneCosine;
    });
  };
  const auto begin = contacts.begin() + static_cast<std::ptrdiff_t>(corners);
  contacts.erase(std::remove_if(begin, contacts.end(), isCovered), contacts.end());
}

ContactId TerrainCollider::idOf(NodeId node, int part, int triangle) const {
  return {static_cast<int>(placement_.tree.tree().level(node)), static_cast<int>(node), part, triangle};
}

Contact TerrainCollider::contactOfBall(const TriangleTouch& touch) const {
  const PlacedTree& tree = placement_.tree;
  const NodeId node = touch.pair.a;
  const Sphere ball = tree.sphere(node);
  const auto side = static_cast<float>(sideOf_[touch.pair.b]);
  const float height = side * touch.distance;
  Contact contact;
  contact.ofSpheres = true;
  contact.pair = {node, 0};
  contact.normal = side * touch.line;
  contact.separation = height - ball.radius - placement_.treeMargin;
  if (const float inner = tree.innerRadius(node); inner > 0)
    contact.certainDepth = std::max(0.0F, inner - height - kOverlapSlack * (ball.radius + touch.distance));
  contact.position = touch.nearest + contact.normal * (0.5F * contact.separation);
  contact.id = idOf(node, 0, indices_[touch.pair.b]);
  return contact;
}

Contact TerrainCollider::boundingContact(const NodePair& pair) {
  forgetFrom(0);
  gather(pair.a);
  if (const std::span<TriangleTouch> touches = measure(); !touches.empty()) return contactOfBall(touches.front());
  // No ground is near.
  Contact contact;
  contact.ofSpheres = true;
  contact.pair = pair;
  contact.normal = Vec3(pairFromTerrain_.rotation * Vec3d(0, 0, 1));
  contact.separation = placement_.maxSeparation;
  contact.position = placement_.tree.sphere(pair.a).center;
  contact.id = idOf(pair.a, 0, -1);
  return contact;
}

std::uint32_t TerrainCollider::appendRootContacts(std::vector<Contact>& contacts) {
  const float covered = kCoveredFraction * placement_.tree.sphere(kRootNode).radius;
  const auto onGround = [](const Contact& c) { return c.onTree() - c.normal * c.separation; };
  forgetFrom(0);
  gather(kRootNode);
  rootContacts_.clear();
  const std::span<TriangleTouch> touches = measure();
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (sides_[i] != 0) rootContacts_.push_back(contactOfBall(touches[i]));
  std::uint32_t found = 0;
  for (; found < kMaxRootContacts && !rootContacts_.empty(); ++found) {
    Contact nearest = rootContacts_.front();
    nearest.isRootContact = true;
    contacts.push_back(nearest);
    std::erase_if(rootContacts_, [&](const Contact& c) {
      const bool isCovered = dot(nearest.normal, onGround(c) - onGround(nearest)) <= covered;
      return isCovered || dot(nearest.normal, c.normal) > kSameMotionCosine;
    });
  }
  return found;
}

}  // namespace cairn::bullet
