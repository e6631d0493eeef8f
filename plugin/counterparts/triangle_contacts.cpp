// SPDX-License-Identifier: Zlib
#include "counterparts/triangle_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::bullet {

namespace {

// Fraction of the leaf's radius by which a point must stand before a plane to count as a surface of its own.
constexpr float kCoveredFraction = 0.01F;

// A region touches what it faces. One that faces along the normal either has sunk through the triangle with its centre,
// and the normal is reversed, or belongs to the far side of the body and touches nothing (zero): the body's centre of
// mass tells which, because the reversed normal has to point to its side.
Vec3 touchingNormal(const PlacedTree& tree, NodeId leaf, const Vec3& nearest, const Vec3& normal) {
  if (!tree.facesAlong(leaf, normal)) return normal;
  const Vec3 centerOfMass = tree.toPair().translation;
  return dot(normal, centerOfMass - nearest) < 0 ? -normal : Vec3{};
}

float overhang(std::span<const Triangle> triangles, const auto& touches, const Vec3& p) {
  float nearestSq = std::numeric_limits<float>::max();
  for (const auto& t : touches)
    nearestSq = std::min(nearestSq, lengthSq(p - nearestOnTriangle(triangles[t.pair.b], p).point));
  return std::sqrt(nearestSq);
}

}  // namespace

TriangleContacts::Touch TriangleContacts::touchOf(const PlacedTree& tree, const Triangle& triangle,
                                                  const NodePair& pair) const {
  const Vec3 center = tree.sphere(pair.a).center;
  const TrianglePoint nearest = nearestOnTriangle(triangle, center);
  const Vec3 out = center - nearest.point;
  const float distance = length(out);
  const Vec3 winding = triangle.normal();
  Touch touch{pair, nearest.point, winding, winding, distance, nearest.onFace};
  touch.face = touchingNormal(tree, pair.a, nearest.point, dot(winding, out) < 0 ? -winding : winding);
  touch.normal =
      nearest.onFace || distance == 0 ? touch.face : touchingNormal(tree, pair.a, nearest.point, out / distance);
  return touch;
}

void TriangleContacts::append(const PlacedTree& tree, float margin, float reach, std::span<const Triangle> triangles,
                              std::span<const NodePair> pairs, std::vector<Contact>& contacts) {
  touches_.clear();
  for (const NodePair& pair : pairs) {
    const Touch touch = touchOf(tree, triangles[pair.b], pair);
    if (lengthSq(touch.normal) > 0) touches_.push_back(touch);
  }
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
      return dot(g.first->normal, touch.nearest - g.first->nearest) <= tolerance;
    });
    if (covered) continue;
    groups_.push_back({&touch, {}, -std::numeric_limits<float>::max(), {}});
    offer(tree, groups_.back(), touch.normal);
    if (!touch.onFace) offer(tree, groups_.back(), touch.face);
  }
  for (const Group& g : groups_) {
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
