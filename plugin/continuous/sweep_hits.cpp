// SPDX-License-Identifier: Zlib
//
// Finds where, and along which direction, two approaching regions meet.
#include <algorithm>
#include <cmath>

#include "cairn/bullet/sphere_tree_shape.h"
#include "contacts/facing_corners.h"
#include "continuous/lateral_separation.h"
#include "continuous/sweep.h"
#include "placement/bullet_math.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

namespace {

// Fraction of the displacement. Regions that close by less along a direction pass each other.
constexpr float kPassingFraction = 1e-4F;
// Least length across the motion that a unit line must have to give a direction.
constexpr float kMinBeside = 0.1F;

}  // namespace

Vec3 Sweep::apartAlong(const Vec3& normal, const NodePair& nodes, const TreeParts& tree, const Mat3& otherAxes) const {
  return tree.support(nodes.a, -normal) - supportOf(*target_, nodes.b, otherAxes, normal);
}

float Sweep::separationAlong(const Vec3& normal, const NodePair& nodes, const TreeParts& tree,
                             const Mat3& otherAxes) const {
  return dot(normal, apartAlong(normal, nodes, tree, otherAxes)) - target_->margin() - margin_;
}

// Two regions that come together within a segment.
struct Sweep::Approach {
  const Sweep& sweep;
  const Segment& segment;
  NodePair nodes;
  MovedNode node;
  float entry;  // fraction of the segment at which they are near
  float sunk;   // depth up to which they still count as apart

  float separation(const Vec3& normal) const {
    return sweep.separationAlong(normal, nodes, segment.tree, segment.otherAxes);
  }
  float separationAtEnd(const Vec3& normal) const {
    return sweep.separationAlong(normal, nodes, segment.treeAtEnd, segment.otherAxesAtEnd);
  }
  float closing(const Vec3& normal) const { return -dot(normal, node.displacement); }
  bool passes(const Vec3& normal) const { return closing(normal) <= kPassingFraction * length(node.displacement); }
  bool areSeparated(const Vec3& normal, float at) const { return separation(normal) - closing(normal) * at > -sunk; }
  // Whether they are beside each other all the way, past an edge or a corner, along a direction that need not be a
  // face's. `normal`: any direction to start from.
  bool isPassing(const Vec3& normal) const {
    const auto start = [&](const Vec3& n) { return sweep.apartAlong(n, nodes, segment.tree, segment.otherAxes); };
    const auto end = [&](const Vec3& n) {
      return sweep.apartAlong(n, nodes, segment.treeAtEnd, segment.otherAxesAtEnd);
    };
    const auto nearer = [&](const Vec3& n) {
      const Vec3 atStart = start(n), atEnd = end(n);
      return dot(n, atStart) < dot(n, atEnd) ? atStart : atEnd;
    };
    return LateralSeparation(unitVector(node.displacement))
        .direction(start(normal), sweep.target_->margin() + sweep.margin_, nearer)
        .has_value();
  }
  Hit hit(const Vec3& normal) const {
    const float now = separation(normal), closes = now - separationAtEnd(normal);
    return {closes > 0 ? std::clamp(now / closes, entry, 1.0F) : entry, normal, closes};
  }
};

// Returns how many of the normals belong to the other side; those come first.
std::size_t Sweep::collectNormals(const Approach& approach) {
  normals_.clear();
  const Vec3& displacement = approach.node.displacement;
  const Mat3& otherAxes = approach.segment.otherAxes;
  const Vec3 center = approach.node.ball.center + displacement * approach.entry;
  target_->appendNormals(approach.nodes.b, transpose(otherAxes) * center, normals_);
  normals_.turn(otherAxes);
  const std::size_t ofOther = normals_.all().size();
  approach.segment.tree.appendFaces(approach.nodes.a, normals_);
  if (normals_.all().empty()) return ofOther;
  const Vec3 along = unitVector(displacement), line = normals_.all().front(), beside = line - along * dot(along, line);
  if (const float norm = length(beside); norm > kMinBeside) normals_.add(beside / norm, false);
  return ofOther;
}

// Along each direction the regions stay apart for a while; the hit is along the one where they do so for longest. Empty
// if they stay apart to the end of the segment, or if they are in contact already.
std::optional<Sweep::Hit> Sweep::hitOf(const SweptPair& pair, const Segment& segment, const Candidate& candidate) {
  const MovedNode node = moved(segment, candidate.pair.a);
  if (lengthSq(node.displacement) == 0) return std::nullopt;
  const float radius = std::min(node.ball.radius, target_->radius(candidate.pair.b));
  const Approach approach{*this, segment,         candidate.pair,
                          node,  candidate.entry, std::max(pair.maxSeparation, kSunkFraction * radius)};
  const std::size_t ofOther = collectNormals(approach);
  std::optional<Hit> latest;
  for (const Vec3& normal : normals_.all()) {
    if (!approach.areSeparated(normal, candidate.entry)) continue;
    if (approach.passes(normal) || approach.separation(normal) - node.slack + approach.sunk >= approach.closing(normal))
      return std::nullopt;
    // The slack is larger than the true effect of rotation, which is known at the segment's end.
    if (approach.separationAtEnd(normal) > -approach.sunk) return std::nullopt;
    const Hit hit = approach.hit(normal);
    if (!latest || hit.at > latest->at) latest = hit;
  }
  if (latest && approach.isPassing(latest->normal)) return std::nullopt;
  if (latest) return flattest(approach, *latest, ofOther);
  if (segment.from == 0 && candidate.entry == 0) noteSunk(segment, candidate.pair);
  return std::nullopt;
}

// Where surfaces of several faces continue flat, an edge between two of them is no obstacle. Considers the faces along
// whose normals the regions are still apart at the hit, only the other side's if it has any. Takes the one along which
// they close least.
Sweep::Hit Sweep::flattest(const Approach& approach, Hit latest, std::size_t ofOther) const {
  bool hasOtherFaces = false;
  for (std::size_t i = 0; i < ofOther; ++i) hasOtherFaces = hasOtherFaces || normals_.isFace(i);
  const float at = latest.at;
  for (std::size_t i = 0; i < (hasOtherFaces ? ofOther : normals_.all().size()); ++i) {
    const Vec3& normal = normals_.all()[i];
    if (!normals_.isFace(i) || approach.passes(normal) || approach.closing(normal) >= latest.closing) continue;
    if (approach.areSeparated(normal, at)) latest = approach.hit(normal);
  }
  return latest;
}

// The smaller region decides the place, because on a flat region any point may be the extreme one. For shapes other
// than trees the corners are known too. Then the place is their common part with the leaf's corners, unless it is a
// single point.
Sweep::Points Sweep::pointsOf(const SweptPair& pair, const Segment& segment, const NodePair& nodes,
                              const Hit& hit) const {
  const auto treeSupport = [&](const Vec3& direction) { return segment.tree.support(nodes.a, direction); };
  const auto otherSupport = [&](const Vec3& direction) {
    return supportOf(*target_, nodes.b, segment.otherAxes, direction);
  };
  const Vec3 onTree = treeSupport(-hit.normal), onOther = otherSupport(hit.normal);
  const Vec3 displacement = moved(segment, nodes.a).displacement * hit.at;
  const Vec3 apart = hit.normal * dot(hit.normal, onTree + displacement - onOther);
  const float treeSize = 2 * segment.tree.sphere(nodes.a).radius, otherSize = 2 * target_->radius(nodes.b);
  Points points;
  FacingCorners ofTree, ofOther;
  if (!asSphereTree(pair.other) && std::isfinite(otherSize)) ofTree.look(-hit.normal, treeSize, treeSupport);
  if (ofTree.corners().size() > 1) {
    ofOther.look(hit.normal, otherSize, otherSupport);
    ofTree.move(displacement);
    points.place.find(hit.normal, ofTree.corners(), ofOther.corners());
    points.onOther = points.place.points().front();
    points.onTree = points.onOther - displacement + apart;
    return points;
  }
  const bool treeKnows = treeSize <= otherSize;
  points.onTree = treeKnows ? onTree : onOther - displacement + apart;
  points.onOther = treeKnows ? onTree + displacement - apart : onOther;
  return points;
}

void Sweep::note(const SweptPair& pair, const Segment& segment, const NodePair& nodes, const Hit& hit) {
  if (isPastFirstHit(nodes.a, segment.from + hit.at * (segment.to - segment.from))) return;
  const Meeting meeting = meetingAt(pair, segment, nodes, hit);
  makeMeeting(nodes.a) = meeting;
}

// Makes the contact at the regions' present places, with the plane that they reach at the hit.
Sweep::Meeting Sweep::meetingAt(const SweptPair& pair, const Segment& segment, const NodePair& nodes, const Hit& hit) {
  const float length = segment.to - segment.from, at = segment.from + hit.at * length;
  const auto inPair = [&](btTransform pose) {
    pose.getOrigin() -= pair.origin;
    return pose;
  };
  const btTransform tree = inPair(pair.treeTrajectory.at(0)), other = inPair(frame_->inWorld());
  const Mat3 otherTurn = toMat3(frame_->at(0).otherAxes) * transpose(segment.otherAxes);
  Contact contact;
  contact.isSpeculative = contact.ofSpheres = true;
  const NodeId leaf = TreeParts::nodeOf(nodes.a);
  contact.pair = {leaf, nodes.b};
  contact.normal = toVec3(other.getBasis() * toBullet(hit.normal));
  const Points points = pointsOf(pair, segment, nodes, hit);
  const Vec3 onTree = toVec3(tree * segment.treeInFrame.invXform(toBullet(points.onTree)));
  const Vec3 onOther = toVec3(other * toBullet(otherTurn * points.onOther));
  contact.separationVector = onTree - onOther - contact.normal * (target_->margin() + margin_);
  const float separation = dot(contact.normal, contact.separationVector);
  const bool isSunk = segment.from < 0;
  if (!isSunk && separation < 0) contact.separationVector -= contact.normal * separation;  // rotation in between
  contact.position = onTree - contact.normal * dot(contact.normal, contact.separationVector);
  contact.separation = -(1 - at) * hit.closing / length;
  contact.id = {static_cast<int>(segment.tree.tree().level(leaf)), static_cast<int>(leaf), -1, pair.otherIndex};
  target_->name(nodes.b, contact);

  const bool isLeftToOthers = segment.from == 0 && separation <= pair.maxSeparation;
  Meeting meeting{at, isSunk ? separation < 0 : !isLeftToOthers, false, nodes, hit.normal, contact};
  for (std::size_t i = 1; i < points.place.points().size(); ++i) {
    const Vec3 beside = points.place.points()[i] - points.onOther;
    meeting.beside[meeting.besideCount++] = toVec3(other.getBasis() * toBullet(otherTurn * beside));
  }
  return meeting;
}

}  // namespace cairn::bullet
