// SPDX-License-Identifier: Zlib
#include "counterparts/triangle_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::bullet {

namespace {

// Fraction of the leaf's radius by which a point must stand before a plane to count as a surface of its own.
constexpr float kCoveredFraction = 0.01F;

// How much of a region (share of its thickness across a triangle, or of its leaf's radius) may be through the triangle
// while the region still counts as on the side its centre is on.
constexpr float kMaySinkFraction = 0.25F;
// Cosine of the 18 degrees off a face's normal within which what is nearest to its border still lies over the face.
constexpr float kOverCosine = 0.95F;

float overhang(std::span<const Triangle> triangles, const auto& touches, const Vec3& p) {
  float nearestSq = std::numeric_limits<float>::max();
  for (const auto& t : touches)
    nearestSq = std::min(nearestSq, lengthSq(p - nearestOnTriangle(triangles[t.pair.b], p).point));
  return std::sqrt(nearestSq);
}

}  // namespace

TriangleContacts::Touch TriangleContacts::touchOf(const PlacedTree& tree, const Triangle& triangle,
                                                  const NodePair& pair) {
  const Vec3 center = tree.sphere(pair.a).center;
  const TrianglePoint nearest = nearestOnTriangle(triangle, center);
  const Vec3 out = center - nearest.point;
  const float distance = length(out);
  const Vec3 winding = triangle.normal();
  Touch touch{pair, nearest.point, winding, {}, winding, distance, nearest.onFace, false};
  touch.side = dot(winding, out) < 0 ? 2 : 1;
  if (touch.side == 2) touch.face = -winding;
  touch.line = nearest.onFace || distance == 0 ? touch.face : out / distance;
  touch.isBeyond = dot(touch.face, tree.toPair().translation - nearest.point) < 0;
  return touch;
}

// Only where the centre of mass is on a triangle's other side can a leaf have sunk through it. A body that reaches
// around a thin sheet looks the same: but there its inner surface faces the sheet from where its outer one turns away,
// and nothing of it stands in the sheet.
void TriangleContacts::findSunk(const PlacedTree& tree, std::size_t triangleCount) {
  standsIn_ = false;
  faced_.assign(triangleCount, 0);
  if (std::none_of(touches_.begin(), touches_.end(), [](const Touch& t) { return t.isBeyond; })) return;
  for (const Touch& t : touches_) {
    const float tolerance = kMaySinkFraction * tree.sphere(t.pair.a).radius;
    const float below = dot(t.face, t.nearest - tree.support(t.pair.a, -t.face));
    if (t.isBeyond && below < tolerance && tree.facesAlong(t.pair.a, -t.face)) faced_[t.pair.b] |= t.side;
    standsIn_ = standsIn_ ||
                (t.onFace && below > tolerance && dot(t.face, tree.support(t.pair.a, t.face) - t.nearest) > tolerance);
  }
}

// A region touches what it faces. One that faces along the normal either has sunk through the triangle with its centre,
// and the normal is reversed, or belongs to the far side of the body and touches nothing (zero). What has sunk belongs
// to the centre of mass's side, wherever it faces.
Vec3 TriangleContacts::touchingNormal(const PlacedTree& tree, const Touch& touch, const Vec3& normal) const {
  const NodeId leaf = touch.pair.a;
  const bool hasSunk = touch.isBeyond && (standsIn_ || (faced_[touch.pair.b] & touch.side) == 0);
  if (tree.facesAlong(leaf, normal)) return hasSunk ? -normal : Vec3{};
  if (!hasSunk) return normal;
  if (tree.facesAlong(leaf, -normal)) return standsIn_ ? Vec3{} : normal;
  const float below = dot(normal, touch.nearest - tree.support(leaf, -normal));
  const float above = dot(normal, tree.support(leaf, normal) - touch.nearest);
  return below > kMaySinkFraction * (below + above) ? -normal : normal;
}

void TriangleContacts::setNormals(const PlacedTree& tree, Touch& touch) const {
  // Beside a triangle there is no side of it to have sunk to.
  const bool isBeside = dot(touch.face, touch.line) < kOverCosine;
  const bool isAway = isBeside && tree.facesAlong(touch.pair.a, touch.line);
  touch.normal = isAway ? Vec3{} : isBeside ? touch.line : touchingNormal(tree, touch, touch.line);
  touch.face = lengthSq(touch.normal) > 0 ? touchingNormal(tree, touch, touch.face) : Vec3{};
}

void TriangleContacts::append(const PlacedTree& tree, float margin, float reach, std::span<const Triangle> triangles,
                              std::span<const NodePair> pairs, std::vector<Contact>& contacts) {
  touches_.clear();
  for (const NodePair& pair : pairs) {
    const Touch touch = touchOf(tree, triangles[pair.b], pair);
    if (lengthSq(touch.line) > 0) touches_.push_back(touch);
  }
  findSunk(tree, triangles.size());
  for (Touch& touch : touches_) setNormals(tree, touch);
  std::sort(touches_.begin(), touches_.end(), [](const Touch& x, const Touch& y) {
    if (x.pair.a != y.pair.a) return x.pair.a < y.pair.a;
    if (x.distance != y.distance) return x.distance < y.distance;
    return x.pair.b < y.pair.b;
  });
  for (auto first = touches_.begin(); first != touches_.end();) {
    const auto last = std::find_if(first, touches_.end(), [&](const Touch& t) { return t.pair.a != first->pair.a; });
    appendLeaf(tree, {first, last}, margin, reach, triangles, contacts);
    first = last;
  }
}

void TriangleContacts::offer(const PlacedTree& tree, Group& group, const Vec3& normal) const {
  if (lengthSq(normal) == 0) return;  // a degenerate triangle has no face
  const Vec3 onTree = tree.support(group.first->pair.a, -normal);
  const float height = dot(normal, onTree - group.first->nearest);
  if (height <= group.height) return;
  group.normal = normal;
  group.height = height;
  group.onTree = onTree;
}

void TriangleContacts::appendLeaf(const PlacedTree& tree, std::span<const Touch> touches, float margin, float reach,
                                  std::span<const Triangle> triangles, std::vector<Contact>& contacts) {
  const NodeId leaf = touches[0].pair.a;
  const float tolerance = kCoveredFraction * tree.sphere(leaf).radius;
  groups_.clear();
  for (const Touch& touch : touches) {
    const auto shared = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
      return !g.first->onFace && !touch.onFace && lengthSq(g.first->nearest - touch.nearest) < tolerance * tolerance;
    });
    if (shared != groups_.end()) {
      offer(tree, *shared, touch.face);
      continue;
    }
    const bool covered = std::any_of(groups_.begin(), groups_.end(), [&](const Group& g) {
      const bool isTouch = lengthSq(g.first->normal) > 0;
      return dot(isTouch ? g.first->normal : g.first->line, touch.nearest - g.first->nearest) <= tolerance;
    });
    if (covered) continue;
    groups_.push_back({&touch, {}, -std::numeric_limits<float>::max(), {}});
    offer(tree, groups_.back(), touch.normal);
    if (!touch.onFace) offer(tree, groups_.back(), touch.face);
  }
  for (const Group& g : groups_) {
    if (lengthSq(g.normal) == 0) continue;
    Contact contact;
    contact.gap = g.height - margin;
    if (contact.gap >= reach) continue;
    contact.pair = g.first->pair;
    contact.normal = g.normal;
    const bool overhangs = overhang(triangles, touches, g.onTree) > std::max(g.height, 0.0F) + reach;
    const Vec3 where = overhangs ? 0.5F * (g.onTree + g.first->nearest) : g.onTree;
    contact.position = where + g.normal * (dot(g.normal, g.first->nearest - where) + 0.5F * contact.gap);
    contacts.push_back(contact);
  }
}

}  // namespace cairn::bullet
