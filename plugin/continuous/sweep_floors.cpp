// SPDX-License-Identifier: Zlib
//
// Edges inside a floor are not obstacles. A body that is stopped by one face of a floor does not reach the place where
// it would hit the next face.
#include <algorithm>
#include <cmath>

#include "continuous/sweep.h"

namespace cairn::bullet {

namespace {

// Cosine of the 5 degrees within which normals belong to one flat face of a rounded mesh.
constexpr float kFloorCosine = 0.996194698F;
// Fraction of a region's radius within which it belongs to a floor's plane.
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
    if (!isFloor) markTested(normal);
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

// Height of a region's surface along a normal from the other side to the tree, at the beginning of the step.
float Sweep::heightOf(bool ofTree, const Segment& start, const NodePair& nodes, const Vec3& normal) const {
  const Vec3 on = ofTree ? start.tree.support(nodes.a, -normal) : supportOf(*target_, nodes.b, start.otherAxes, normal);
  return dot(normal, on);
}

// The earliest meeting that was not tested yet.
const Sweep::Meeting* Sweep::nextMeeting() {
  Meeting* next = nullptr;
  for (Meeting& m : meetings_)
    if (!m.isAsked && m.at >= 0 && m.at < kNotMet && (!next || m.at < next->at)) next = &m;
  if (next) next->isAsked = true;
  return next;
}

// Marks all meetings along this direction as tested.
void Sweep::markTested(const Vec3& normal) {
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

// Whether a region has a face at the floor's height.
bool Sweep::isLevel(const Floor& floor, const Segment& start, const NodePair& nodes) const {
  const float radius = floor.isTrees ? start.tree.sphere(nodes.a).radius : target_->radius(nodes.b);
  const float beside = heightOf(floor.isTrees, start, nodes, floor.normal) - floor.height;
  return std::abs(beside) <= kFloorFraction * radius;
}

// Whether a part of the body on the floor is above it at the beginning of the step, or no deeper than sliding parts
// are.
bool Sweep::isInFront(const Floor& floor, const Segment& start, const NodePair& nodes, float maxSeparation) const {
  const float radius = floor.isTrees ? target_->radius(nodes.b) : start.tree.sphere(nodes.a).radius;
  return separationAlong(floor.normal, nodes, start.tree, start.otherAxes) >=
         -std::max(maxSeparation, kSunkFraction * radius);
}

// Whether a later meeting belongs to another region of the same floor, which the part was above when the step began.
bool Sweep::standsOn(const Floor& floor, const Segment& start, const Meeting& m, float maxSeparation) {
  if (!m.isContact || m.at <= floor.at) return false;
  if (floor.isTrees ? m.nodes.a == floor.nodes.a : m.nodes.b == floor.nodes.b) return false;
  return isFace(floor.isTrees, start, m.nodes, floor.normal) && isLevel(floor, start, m.nodes) &&
         isInFront(floor, start, m.nodes, maxSeparation);
}

// Ordinary contacts hold a body that lies in a floor already, placed or pressed into it. The floor's edges are no
// obstacles to it. A part that swings up through the floor from below was never above it.
void Sweep::noteSunk(const Segment& start, const NodePair& nodes) {
  noteSunkInto(true, start, nodes);
  noteSunkInto(false, start, nodes);
}

void Sweep::noteSunkInto(bool isTrees, const Segment& start, const NodePair& nodes) {
  // The middle of the body on the floor; the other's is the origin of its frame.
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

// Whether a region with a face in the floor's plane is met along none of its other faces.
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

// Meets the floor along its normal, if the part reaches it within the step. Overwrites the meeting in place, because
// the meeting of a split node that was met as a whole cannot be looked up.
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
