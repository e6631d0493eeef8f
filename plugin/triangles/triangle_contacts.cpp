// SPDX-License-Identifier: Zlib
#include "triangles/triangle_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::bullet {

namespace {

// Fraction of the leaf's radius by which a point must rise above a plane to count as a surface of its own.
constexpr float kStandsOutFraction = 0.01F;

float overhang(std::span<const Triangle> triangles, const auto& touches, const Vec3& p) {
  float nearestSq = std::numeric_limits<float>::max();
  for (const auto& t : touches)
    nearestSq = std::min(nearestSq, lengthSq(p - nearestOnTriangle(triangles[t.pair.b], p).point));
  return std::sqrt(nearestSq);
}

}  // namespace

// A region touches only surfaces it faces; one that faces along the normal belongs to the far side of the body.
TriangleContacts::Touch TriangleContacts::onSide(const PlacedTree& tree, const TriangleTouch& touch, int side) {
  const auto sign = static_cast<float>(side);
  Touch t{touch, sign * touch.line, sign * touch.face};
  if (tree.facesAlong(touch.pair.a, t.normal)) t.normal = t.faceNormal = {};
  if (tree.facesAlong(touch.pair.a, t.faceNormal)) t.faceNormal = {};
  return t;
}

void TriangleContacts::append(const PairPlacement& placement, std::span<const Triangle> triangles,
                              std::span<const NodePair> pairs, bool isComplete, TriangleSides& sides,
                              std::vector<Contact>& contacts) {
  const std::span<const TriangleTouch> touches = measure(placement, triangles, pairs);
  appendMeasured(placement, triangles, sides.settle(placement.tree, triangles, touches, isComplete), contacts);
}

std::span<TriangleTouch> TriangleContacts::measure(const PairPlacement& placement, std::span<const Triangle> triangles,
                                                   std::span<const NodePair> pairs) {
  all_.clear();
  for (const NodePair& pair : pairs) {
    const TriangleTouch touch = touchOf(placement.tree, triangles[pair.b], pair);
    if (lengthSq(touch.line) > 0) all_.push_back(touch);
  }
  std::sort(all_.begin(), all_.end(), [](const TriangleTouch& x, const TriangleTouch& y) {
    if (x.pair.a != y.pair.a) return x.pair.a < y.pair.a;
    if (x.distance != y.distance) return x.distance < y.distance;
    return x.pair.b < y.pair.b;
  });
  return all_;
}

void TriangleContacts::appendMeasured(const PairPlacement& placement, std::span<const Triangle> triangles,
                                      std::span<const int> sides, std::vector<Contact>& contacts) {
  touches_.clear();
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (sides[i] != 0) touches_.push_back(onSide(placement.tree, all_[i], sides[i]));
  for (auto first = touches_.begin(); first != touches_.end();) {
    const auto last = std::find_if(first, touches_.end(), [&](const Touch& t) { return t.pair.a != first->pair.a; });
    appendLeaf(placement, {&*first, static_cast<std::size_t>(last - first)}, triangles, contacts);
    first = last;
  }
}

void TriangleContacts::offer(const PlacedTree& tree, Group& group, const Vec3& normal) {
  if (lengthSq(normal) == 0) return;  // a degenerate triangle has no face
  const Vec3 onTree = tree.certainReach(group.first->pair.a, -normal);
  const float height = dot(normal, onTree - group.first->nearest);
  if (height <= group.height) return;
  group.normal = normal;
  group.height = height;
  group.onTree = onTree;
}

void TriangleContacts::group(const PlacedTree& tree, std::span<const Touch> touches) {
  const float tolerance = kStandsOutFraction * tree.sphere(touches[0].pair.a).radius;
  groups_.clear();
  for (const Touch& touch : touches) {
    const auto shared = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
      return !g.first->onFace && !touch.onFace && lengthSq(g.first->nearest - touch.nearest) < tolerance * tolerance;
    });
    if (shared != groups_.end()) {
      offer(tree, *shared, touch.faceNormal);
      continue;
    }
    const bool covered = std::any_of(groups_.begin(), groups_.end(), [&](const Group& g) {
      const bool isTouch = lengthSq(g.first->normal) > 0;
      return dot(isTouch ? g.first->normal : g.first->line, touch.nearest - g.first->nearest) <= tolerance;
    });
    if (covered) continue;
    groups_.push_back({&touch, {}, -std::numeric_limits<float>::max(), {}});
    offer(tree, groups_.back(), touch.normal);
    if (!touch.onFace) offer(tree, groups_.back(), touch.faceNormal);
  }
}

void TriangleContacts::appendLeaf(const PairPlacement& placement, std::span<const Touch> touches,
                                  std::span<const Triangle> triangles, std::vector<Contact>& contacts) {
  group(placement.tree, touches);
  for (const Group& g : groups_) {
    if (lengthSq(g.normal) == 0) continue;
    Contact contact;
    contact.separation = g.height - placement.treeMargin;
    if (contact.separation >= placement.maxSeparation) continue;
    contact.pair = g.first->pair;
    contact.normal = g.normal;
    const bool overhangs = overhang(triangles, touches, g.onTree) > std::max(g.height, 0.0F) + placement.maxSeparation;
    const Vec3 where = overhangs ? 0.5F * (g.onTree + g.first->nearest) : g.onTree;
    contact.position = where + g.normal * (dot(g.normal, g.first->nearest - where) + 0.5F * contact.separation);
    contacts.push_back(contact);
  }
}

}  // namespace cairn::bullet
