// SPDX-License-Identifier: Zlib
#include "counterparts/triangle_sides.h"

namespace cairn::bullet {

namespace {

// How much of a region (share of its thickness across a triangle) may be through the triangle while the region still
// counts as on the side its centre is on.
constexpr float kMaySinkFraction = 0.25F;

// How far (in radii of the sphere that asks) the planes of triangles may be apart that tell each other's side.
constexpr float kOnePlaneFraction = 0.5F;

float massHeight(const PlacedTree& tree, const TriangleTouch& touch) {
  return dot(touch.face, tree.toPair().translation - touch.nearest);
}

}  // namespace

std::span<const int> TriangleSides::settle(const PairPlacement& placement, std::span<const Triangle> triangles,
                                           std::span<const TriangleTouch> touches, bool isComplete) {
  const PlacedTree& tree = placement.tree;
  back_ = placement.motion.backOneStep();
  sides_.clear();
  for (const TriangleTouch& touch : touches) sides_.push_back(touch.isOver() ? 0 : 1);
  settle(touches, [&](const TriangleTouch& t) { return seen_.ofNode(t.pair.a, t.face); });
  settle(touches, [&](const TriangleTouch& t) { return byPath(tree, triangles[t.pair.b], t); });
  settle(touches, [&](const TriangleTouch& t) { return byFacing(tree, t); });
  settle(touches, [&](const TriangleTouch& t) { return byBody(tree, t); });
  if (!isComplete) dropUncovered(tree, touches);
  return sides_;
}

// What has sunk beside a triangle would be pushed away along the surface; the one it has sunk through covers that.
void TriangleSides::dropUncovered(const PlacedTree& tree, std::span<const TriangleTouch> touches) {
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (!touches[i].isOver() && ofTree(tree, touches[i]) < 0) sides_[i] = 0;
}

// What one way of telling has settled is seen by the next.
void TriangleSides::settle(std::span<const TriangleTouch> touches, const auto& sideOf) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const TriangleTouch& touch = touches[i];
    if (touch.pair.a != touches[nearest].pair.a) nearest = i;
    if (sides_[i] != 0) continue;
    // What is in front of the nearest triangle went around the borders of the others, not through them.
    const bool isAround = !touch.onFace && i != nearest && sides_[nearest] == 1 && touches[nearest].isOver();
    sides_[i] = isAround ? 1 : sideOf(touch);
    const bool isTelling = sides_[i] != 0 && (touch.onFace || i == nearest);
    if (isTelling) seen_.note(touch.pair.a, static_cast<float>(sides_[i]) * touch.face, touch.nearest);
  }
  seen_.endNotes();
}

int TriangleSides::ofTree(const PlacedTree& tree, const TriangleTouch& touch) const {
  return seen_.ofTree(touch.face, touch.nearest, kOnePlaneFraction * tree.sphere(touch.pair.a).radius);
}

bool TriangleSides::hasPassed(const PlacedTree& tree, const TriangleTouch& touch) const {
  return dot(touch.face, back_ * tree.sphere(touch.pair.a).center - touch.nearest) < 0;
}

int TriangleSides::byPath(const PlacedTree& tree, const Triangle& triangle, const TriangleTouch& touch) const {
  const Vec3 center = tree.sphere(touch.pair.a).center, last = back_ * center;
  const float now = dot(touch.face, center - touch.nearest), before = dot(touch.face, last - touch.nearest);
  if (before >= 0) return 0;
  const Vec3 crossing = center + (last - center) * (now / (now - before));
  if (!nearestOnTriangle(triangle, crossing).onFace) return 0;
  // What comes out of a surface that the body is in front of had sunk too deep to be seen.
  return ofTree(tree, touch) > 0 && massHeight(tree, touch) > 0 ? 1 : -1;
}

int TriangleSides::byFacing(const PlacedTree& tree, const TriangleTouch& touch) const {
  const int treeSide = ofTree(tree, touch);
  if (treeSide < 0 && hasPassed(tree, touch)) return -1;
  if (static_cast<float>(treeSide) * massHeight(tree, touch) > 0) return treeSide;
  return tree.facesAlong(touch.pair.a, -touch.face) ? 1 : 0;
}

int TriangleSides::byBody(const PlacedTree& tree, const TriangleTouch& touch) const {
  if (const int side = ofTree(tree, touch); side != 0) return side;
  // Off a triangle's face a region may reach through its plane and be nowhere near it.
  if (!touch.onFace || massHeight(tree, touch) >= 0) return 1;
  const NodeId leaf = touch.pair.a;
  const float below = dot(touch.face, touch.nearest - tree.support(leaf, -touch.face));
  const float above = dot(touch.face, tree.support(leaf, touch.face) - touch.nearest);
  if (!seen_.isFirst() && below < 0) return 1;
  return tree.facesAlong(leaf, touch.face) || below > kMaySinkFraction * (below + above) ? -1 : 1;
}

int TriangleSides::ofBall(const PlacedTree& tree, const TriangleTouch& touch) const {
  if (!touch.isOver()) return 1;
  if (const int side = seen_.ofNode(touch.pair.a, touch.face); side != 0) return side;
  return ofTree(tree, touch) < 0 ? -1 : 1;
}

void TriangleSides::noteBall(const TriangleTouch& touch, const Vec3& direction) {
  if (touch.isOver()) seen_.note(touch.pair.a, direction, touch.nearest);
  seen_.endNotes();
}

}  // namespace cairn::bullet
