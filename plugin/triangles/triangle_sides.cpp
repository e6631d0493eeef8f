// SPDX-License-Identifier: Zlib
#include "triangles/triangle_sides.h"

#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Fraction of a region's thickness across a triangle that may be through the triangle, while the region still counts as
// on its centre's side.
constexpr float kMaySinkFraction = 0.25F;
// Distance between planes (in radii of the sphere asked about) within which they count as one surface.
constexpr float kOneSurfaceFraction = 0.05F;
// Distance (in radii of the root) beyond its speed by which a tree may move in a step without having been set down.
constexpr btScalar kTreeMotionFraction = btScalar(0.5);

float massHeight(const PlacedTree& tree, const TriangleTouch& touch) {
  return dot(touch.face, tree.toPair().translation - touch.nearest);
}

}  // namespace

void TriangleSides::reset() {
  seen_.reset();
  hasPast_ = false;
}

void TriangleSides::beginStep(const PairPlacement& placement) {
  const PlacedTree& tree = placement.tree;
  const btTransform carry = hasPast_ ? placement.other * other_.inverse() : btTransform::getIdentity();
  back_ = hasPast_ ? carry * treeBody_ * placement.treeBody.inverse() : btTransform::getIdentity();
  treeBody_ = placement.treeBody;
  other_ = placement.other;
  const btScalar moved = back_.getOrigin().length();  // of the tree's body, which is at the pair frame's origin
  const btScalar own = btScalar(placement.travel) + kTreeMotionFraction * btScalar(tree.sphere(kRootNode).radius);
  if (moved > own) {
    reset();
    back_.setIdentity();
  }
  hasPast_ = true;
  seen_.beginStep([&](SurfaceSide& side) {
    side.point = toVec3(carry * toBtVector3(side.point));
    side.normal = toVec3(carry.getBasis() * toBtVector3(side.normal));
  });
}

std::span<const int> TriangleSides::settle(const PlacedTree& tree, std::span<const Triangle> triangles,
                                           std::span<const TriangleTouch> touches, bool isComplete) {
  sides_.clear();
  for (const TriangleTouch& touch : touches) sides_.push_back(touch.isOver() ? 0 : 1);
  settleBy(tree, touches, [&](const TriangleTouch& t) { return ofNode(tree, t); });
  settleBy(tree, touches, [&](const TriangleTouch& t) { return byPath(tree, triangles[t.pair.b], t); });
  settleBy(tree, touches, [&](const TriangleTouch& t) { return byFacing(tree, t); });
  settleBy(tree, touches, [&](const TriangleTouch& t) { return byBody(tree, t); });
  if (!isComplete) dropUncovered(tree, touches);
  return sides_;
}

// Away from a triangle's face, only the nearest triangle can tell a node that has sunk through from one that went
// around the border. The same holds for a node beside a triangle but behind another.
void TriangleSides::dropUncovered(const PlacedTree& tree, std::span<const TriangleTouch> touches) {
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const TriangleTouch& touch = touches[i];
    const bool isBehind = !touch.isOver() && seen_.isBehind(touch.pair.a, tree.sphere(touch.pair.a).center);
    if (!touch.onFace && (sides_[i] < 0 || isBehind)) sides_[i] = 0;
  }
}

// Sides settled by one rule are known to the next.
void TriangleSides::settleBy(const PlacedTree& tree, std::span<const TriangleTouch> touches, const auto& sideOf) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const TriangleTouch& touch = touches[i];
    if (touch.pair.a != touches[nearest].pair.a) nearest = i;
    if (sides_[i] != 0) continue;
    // A node in front of the nearest triangle went around the borders of the others, not through them.
    const bool isAround = !touch.onFace && i != nearest && sides_[nearest] == 1 && touches[nearest].isOver();
    int side = isAround ? 1 : sideOf(touch);
    if (side == 0) continue;
    const auto direction = [&] { return static_cast<float>(side) * touch.face; };
    if (static_cast<float>(side) * massHeight(tree, touch) < 0 && seen_.isOutvoted(direction())) side = -side;
    sides_[i] = side;
    if (touch.onFace || i == nearest) seen_.note(touch.pair.a, {touch.nearest, direction()});
  }
  seen_.endNotes();
}

int TriangleSides::ofTree(const PlacedTree& tree, const TriangleTouch& touch) const {
  return seen_.ofTree({touch.nearest, touch.face}, kOneSurfaceFraction * tree.sphere(touch.pair.a).radius);
}

int TriangleSides::ofNode(const PlacedTree& tree, const TriangleTouch& touch) const {
  const NodeId node = touch.pair.a;
  return seen_.ofNode(node, {touch.nearest, touch.face}, kOneSurfaceFraction * tree.sphere(node).radius);
}

Vec3 TriangleSides::centerBefore(const PlacedTree& tree, NodeId node) const {
  return toVec3(back_ * toBtVector3(tree.sphere(node).center));
}

int TriangleSides::byPath(const PlacedTree& tree, const Triangle& triangle, const TriangleTouch& touch) const {
  const Vec3 center = tree.sphere(touch.pair.a).center, last = centerBefore(tree, touch.pair.a);
  const float now = dot(touch.face, center - touch.nearest), before = dot(touch.face, last - touch.nearest);
  if (before >= 0) return 0;
  const Vec3 crossing = center + (last - center) * (now / (now - before));
  if (!nearestOnTriangle(triangle, crossing).onFace) return 0;
  // A node that comes out of a surface in front of which the body is had sunk too deep to be seen.
  return ofTree(tree, touch) > 0 && massHeight(tree, touch) > 0 ? 1 : -1;
}

int TriangleSides::byFacing(const PlacedTree& tree, const TriangleTouch& touch) const {
  const int treeSide = ofTree(tree, touch);
  const bool hasPassed = dot(touch.face, centerBefore(tree, touch.pair.a) - touch.nearest) < 0;
  if (treeSide < 0 && hasPassed) return -1;
  if (static_cast<float>(treeSide) * massHeight(tree, touch) > 0) return treeSide;
  return tree.facesAlong(touch.pair.a, -touch.face) ? 1 : 0;
}

int TriangleSides::byBody(const PlacedTree& tree, const TriangleTouch& touch) const {
  if (const int side = ofTree(tree, touch); side != 0) return side;
  // Away from a triangle's face, a region may pass through its plane without being near it.
  if (!touch.onFace || massHeight(tree, touch) >= 0) return 1;
  const NodeId leaf = touch.pair.a;
  const float below = dot(touch.face, touch.nearest - tree.support(leaf, -touch.face));
  const float above = dot(touch.face, tree.support(leaf, touch.face) - touch.nearest);
  if (!seen_.isFirst() && below < 0) return 1;
  return tree.facesAlong(leaf, touch.face) || below > kMaySinkFraction * (below + above) ? -1 : 1;
}

// A ring may swing through a sheet until its ball's centre is through. The ring's centre of mass tells this from
// sinking.
int TriangleSides::ofBall(const PlacedTree& tree, const TriangleTouch& touch) const {
  return touch.isOver() && massHeight(tree, touch) < 0 && ofNode(tree, touch) < 0 ? -1 : 1;
}

void TriangleSides::noteBall(const TriangleTouch& touch, const Vec3& normal) {
  if (touch.isOver()) seen_.noteAlone(touch.pair.a, {touch.nearest, normal});
}

}  // namespace cairn::bullet
