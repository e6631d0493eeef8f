// SPDX-License-Identifier: Zlib
// Edges inside a floor are no obstacles: what flies over one face of it and is stopped by that does not come to where
// it would run into the next.
#include <algorithm>
#include <cmath>

#include "continuous/sweep.h"

namespace cairn::bullet {

namespace {

// Cosine of 5 degrees: normals of one flat face, up to what a mesh's rounding does to them.
constexpr float kFloorCosine = 0.996194698F;
// Of a region's radius: so far beside a floor's plane it is part of that.
constexpr float kFloorFraction = 0.05F;

}  // namespace

void Sweep::keepAboveFloors(const SweptPair& pair) {
  const auto start = std::ranges::find_if(segments_, [](const Segment& s) { return s.from == 0; });
  if (start == segments_.end()) return;
  keepOffSunkFloors(pair, *start);
  for (std::size_t i = 0; i < kMaxFloors; ++i) {
    const Meeting* const next = nextMeeting();
    if (!next) return;
    const NodePair nodes = next->nodes;
    const Vec3 normal = next->normal;
    const float at = next->at;
    bool isFloor = false;
    for (const bool isTrees : {true, false}) {
      if (!isFace(isTrees, *start, nodes, normal)) continue;
      isFloor = true;
      keepAbove({nodes, normal, at, isTrees, heightOf(isTrees, *start, nodes, normal)}, pair, *start);
    }
    if (!isFloor) answer(normal);
  }
}

void Sweep::keepAbove(const Floor& floor, const SweptPair& pair, const Segment& start) {
  for (Meeting& m : meetings_) {
    if (dot(m.normal, floor.normal) > kFloorCosine) {
      m.isAsked = m.isAsked || isLevel(floor, start, m.nodes);
    } else if (standsOn(floor, start, m, pair.maxSeparation)) {
      meetFloor(floor, pair, m);
    }
  }
}

// Where the surface of a region lies along a normal from the other side to the tree, as the step begins.
float Sweep::heightOf(bool ofTree, const Segment& start, const NodePair& nodes, const Vec3& normal) const {
  const Vec3 on = ofTree ? start.tree.support(nodes.a, -normal) : supportOf(*target_, nodes.b, start.otherAxes, normal);
  return dot(normal, on);
}

// The earliest that was not asked for yet.
const Sweep::Meeting* Sweep::nextMeeting() {
  Meeting* next = nullptr;
  for (Meeting& m : meetings_)
    if (!m.isAsked && m.at >= 0 && m.at < kNotMet && (!next || m.at < next->at)) next = &m;
  if (next) next->isAsked = true;
  return next;
}

// All that are met along this direction.
void Sweep::answer(const Vec3& normal) {
  for (Meeting& m : meetings_)
    if (dot(m.normal, normal) > kFloorCosine) m.isAsked = true;
}

void Sweep::collectFaces(bool ofTree, const Segment& start, const NodePair& nodes) {
  normals_.clear();
  if (ofTree) {
    start.tree.appendFaces(nodes.a, normals_);
  } else {
    target_->appendNormals(nodes.b, transpose(start.otherAxes) * start.tree.sphere(nodes.a).center, normals_);
    normals_.turn(start.otherAxes);
  }
}

bool Sweep::isFace(bool ofTree, const Segment& start, const NodePair& nodes, const Vec3& normal) {
  collectFaces(ofTree, start, nodes);
  for (std::size_t i = 0; i < normals_.all().size(); ++i)
    if (normals_.isFace(i) && dot(normals_.all()[i], normal) > kFloorCosine) return true;
  return false;
}

// Whether a region has a face as high as the floor.
bool Sweep::isLevel(const Floor& floor, const Segment& start, const NodePair& nodes) const {
  const float radius = floor.isTrees ? start.tree.sphere(nodes.a).radius : target_->radius(nodes.b);
  const float beside = heightOf(floor.isTrees, start, nodes, floor.normal) - floor.height;
  return std::abs(beside) <= kFloorFraction * radius;
}

// Whether a part of the body on the floor is above it as the step begins, or no deeper than what slides is.
bool Sweep::isInFront(const Floor& floor, const Segment& start, const NodePair& nodes, float maxSeparation) const {
  const float radius = floor.isTrees ? target_->radius(nodes.b) : start.tree.sphere(nodes.a).radius;
  return separationAlong(floor.normal, nodes, start.tree, start.otherAxes) >=
         -std::max(maxSeparation, kSunkFraction * radius);
}

// Whether what it meets later is another region of that floor, which it was above as the step began.
bool Sweep::standsOn(const Floor& floor, const Segment& start, const Meeting& m, float maxSeparation) {
  if (!m.isContact || m.at <= floor.at) return false;
  if (floor.isTrees ? m.nodes.a == floor.nodes.a : m.nodes.b == floor.nodes.b) return false;
  return isFace(floor.isTrees, start, m.nodes, floor.normal) && isLevel(floor, start, m.nodes) &&
         isInFront(floor, start, m.nodes, maxSeparation);
}

// What lies in a floor already, set down or pressed into it, is held by ordinary contacts. Its edges are no obstacles,
// and what swings up through it from below has never been there.
void Sweep::noteSunk(const Segment& start, const NodePair& nodes) {
  noteSunkInto(true, start, nodes);
  noteSunkInto(false, start, nodes);
}

void Sweep::noteSunkInto(bool isTrees, const Segment& start, const NodePair& nodes) {
  // Of the body on the floor; the other's is where its frame begins.
  const Vec3 middle = isTrees ? Vec3() : start.tree.sphere(kRootNode).center;
  collectFaces(isTrees, start, nodes);
  for (std::size_t i = 0; i < normals_.all().size(); ++i) {
    if (sunkFloors_.size() == kMaxFloors) return;
    if (!normals_.isFace(i)) continue;
    const Vec3& normal = normals_.all()[i];
    const Floor floor{nodes, normal, -1, isTrees, heightOf(isTrees, start, nodes, normal)};
    const float above = dot(normal, middle) - floor.height;
    if ((isTrees ? -above : above) <= 0) continue;
    const auto isKnown = [&](const Floor& known) {
      return known.isTrees == isTrees && dot(known.normal, normal) > kFloorCosine && isLevel(known, start, nodes);
    };
    if (std::ranges::none_of(sunkFloors_, isKnown)) sunkFloors_.push_back(floor);
  }
}

// Of a region with a face in the floor's plane: along no other face of it.
bool Sweep::isEdgeOf(const Floor& floor, const Segment& start, const Meeting& m) {
  if (dot(m.normal, floor.normal) > kFloorCosine) return false;
  if (!isFace(floor.isTrees, start, m.nodes, floor.normal) || !isLevel(floor, start, m.nodes)) return false;
  return dot(m.normal, floor.normal) < -kFloorCosine || !isFace(floor.isTrees, start, m.nodes, m.normal);
}

void Sweep::keepOffSunkFloors(const SweptPair& pair, const Segment& start) {
  for (const Floor& floor : sunkFloors_) {
    for (Meeting& m : meetings_) {
      if (!m.isContact || m.at < 0 || !isEdgeOf(floor, start, m)) continue;
      if (isInFront(floor, start, m.nodes, pair.maxSeparation)) {
        meetFloor(floor, pair, m);
      } else {
        m.isContact = false;
      }
    }
  }
}

// Along the floor's normal, if it comes to that within the step. In its own place: a node that was split and then, for
// want of time, met as a whole has a meeting that is not found by its name.
void Sweep::meetFloor(const Floor& floor, const SweptPair& pair, Meeting& meeting) {
  const NodePair nodes = meeting.nodes;
  meeting = {};
  for (const Segment& s : segments_) {
    if (s.from < 0) continue;
    const float separation = std::max(separationAlong(floor.normal, nodes, s.tree, s.otherAxes), 0.0F);
    const float closing = separation - separationAlong(floor.normal, nodes, s.treeAtEnd, s.otherAxesAtEnd);
    if (closing <= 0 || separation >= closing) continue;
    meeting = meetingAt(pair, s, nodes, {separation / closing, floor.normal, closing});
    break;
  }
  meeting.isAsked = true;
}

}  // namespace cairn::bullet
