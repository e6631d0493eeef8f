// SPDX-License-Identifier: Zlib
#include "kernel/convex_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernel/contact_tuning.h"
#include "kernel/drop_deeper.h"
#include "placement/triangle.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

namespace {

Box boxOf(const PlacedSurface& surface, const ConvexBody& body) {
  Box box;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0F, 1.0F}) {
      Vec3 direction;
      direction[axis] = sign;
      const Vec3 support = surface.fromPair(body.support(surface.directionToPair(direction)));
      (sign < 0 ? box.lower : box.upper)[axis] = support[axis];
    }
  return box;
}

// Whether the surface beyond this side of the face rises above the face by more than `rounding` (mesh unit).
bool isConcave(const PlacedSurface& surface, std::uint32_t index, std::size_t side, float rounding) {
  const SurfaceEdge& edge = surface.features().edges()[surface.features().edgesOf()[index][side]];
  const std::uint32_t beyond = edge.triangle[0] == index ? edge.opposite[1] : edge.opposite[0];
  if (beyond == SurfaceEdge::kNone) return false;
  const SurfaceFace& face = surface.features().faces()[index];
  return dot(face.normal, surface.vertex(beyond)) - face.offset > rounding;
}

// Finds where a condition ends, between a place where it holds and one where it fails.
template <class Holds>
float endOf(float holds, float fails, const Holds& isHeld) {
  for (int i = 0; i < tuning::kMaxIterations; ++i) {
    const float middle = 0.5F * (holds + fails);
    (isHeld(middle) ? holds : fails) = middle;
  }
  return holds;
}

}  // namespace

std::optional<std::span<const FeatureContact>> ConvexContacts::find(const PlacedSurface& surface, ConvexBody& body,
                                                                    const ContactLimits& limits, float surfaceMargin,
                                                                    Budget& budget) {
  begin(surface, body, limits, surfaceMargin);
  if (!listPatches(budget)) return {};
  appendAll();
  limits_.overlap = deepestOf(contacts_);
  if (limits_.overlap > limits.contactDistance && budget.charge(costOfPatches())) appendAll();
  if (isSwallowed()) {
    appendWayOut();
    return contacts_;
  }
  if (isDeep_) return {};
  dropDeeper(contacts_, shallow_, limits,
             [&](const FeatureContact& contact, const FeatureContact& other) { return staysInside(contact, other); });
  return contacts_;
}

void ConvexContacts::begin(const PlacedSurface& surface, ConvexBody& body, const ContactLimits& limits,
                           float surfaceMargin) {
  surface_ = &surface;
  body_ = &body;
  limits_ = limits;
  surfaceMargin_ = surfaceMargin;
  middleOfBody_ = body.middle();
  isDeep_ = false;
  facingAlong_ = {};
  seen_.begin(surface.mesh.vertices.size());
}

const ConvexContacts::Seen& ConvexContacts::seen(std::uint32_t vertex) {
  return seen_.get(vertex, [&] {
    const Vec3 place = surface_->toPair * surface_->vertex(vertex);
    return Seen{place, body_->nearest(place)};
  });
}

bool ConvexContacts::listPatches(Budget& budget) {
  patches_.clear();
  const float maxSeparation = (limits_.maxSeparation + surfaceMargin_ + limits_.rounding()) / surface_->scale;
  const Box box = boxOf(*surface_, *body_).grown(maxSeparation);
  const std::span<const PatchFamily> families = surface_->patches().families();
  waiting_.assign(1, 0);
  while (!waiting_.empty()) {
    if (!budget.charge(kOverlapTestCost * PatchFamily::kWidth)) return false;
    const PatchFamily& family = families[waiting_.back()];
    waiting_.pop_back();
    for (std::uint32_t lane = 0; lane < PatchFamily::kWidth; ++lane) {
      const Box there = family.box(lane);
      if (!(there.separationTo(box) <= 0)) continue;
      if (!family.isPatch(lane))
        waiting_.push_back(family.child[lane]);
      else if (isNear(there))
        patches_.push_back(family.child[lane]);
    }
  }
  return budget.charge(costOfPatches());
}

// Whether the body's middle is inside the surface, and no contact reports an overlap.
bool ConvexContacts::isSwallowed() {
  const bool isReported = !isDeep_ && std::ranges::any_of(contacts_, [](const auto& c) { return c.separation < 0; });
  return !isReported && ray_.isInside(surface_->mesh, surface_->fromPair(middleOfBody_));
}

// Contacts along the line from the body's middle to the nearest point of the surface. Every part of the body that faces
// the other way must move that far.
void ConvexContacts::appendWayOut() {
  contacts_.clear();
  const Vec3 out = surface_->toPair * nearestOnSurface(surface_->fromPair(middleOfBody_));
  if (out == middleOfBody_) return;
  const Vec3 outward = unitVector(out - middleOfBody_);
  facing_.look(-outward, limits_.size, [&](const Vec3& direction) { return body_->support(direction); });
  std::uint32_t corner = 1;
  for (const Vec3& onBody : facing_.corners()) {
    const float separation = separationOf(dot(outward, onBody - out));
    contacts_.push_back(
        {onBody - outward * (0.5F * separation), -outward, separation, FeatureKind::faceOnVertex, 0, corner++});
  }
}

Vec3 ConvexContacts::nearestOnSurface(const Vec3& inMesh) {
  Vec3 nearest;
  float distanceSq = std::numeric_limits<float>::infinity();
  waiting_.assign(1, 0);
  while (!waiting_.empty()) {
    const PatchFamily& family = surface_->patches().families()[waiting_.back()];
    waiting_.pop_back();
    for (std::uint32_t lane = 0; lane < PatchFamily::kWidth; ++lane) {
      const float separation = family.box(lane).separationTo({inMesh, inMesh});
      if (!(separation * std::abs(separation) < distanceSq)) continue;
      if (!family.isPatch(lane)) {
        waiting_.push_back(family.child[lane]);
        continue;
      }
      for (const std::uint32_t face : surface_->patches().patch(family.child[lane]).triangles) {
        const auto& [a, b, c] = surface_->mesh.triangles[face];
        const Vec3 point =
            nearestOnTriangle({surface_->vertex(a), surface_->vertex(b), surface_->vertex(c)}, inMesh).point;
        if (lengthSq(point - inMesh) >= distanceSq) continue;
        nearest = point;
        distanceSq = lengthSq(point - inMesh);
      }
    }
  }
  return nearest;
}

// Tests the ball around the box.
bool ConvexContacts::isNear(const Box& box) {
  const float radius = 0.5F * length(box.upper - box.lower) * surface_->scale;
  return separationOf(body_->apartFrom(surface_->toPair * box.middle())) <=
         radius + limits_.maxSeparation + limits_.rounding();
}

void ConvexContacts::appendAll() {
  contacts_.clear();
  for (const std::uint32_t index : patches_) {
    const SurfacePatch& patch = surface_->patches().patch(index);
    for (const std::uint32_t vertex : patch.vertices.first(patch.ownVertices)) appendVertex(vertex);
    for (const std::uint32_t edge : patch.edges.first(patch.convexEdges)) appendEdge(edge);
    for (const std::uint32_t face : patch.triangles) appendFace(face);
  }
}

// Trusts a separation that `ContactLimits` trusts. Trusts deeper overlap too, as long as the other body's middle is
// still on this side: `outside` is its height over the contact's plane.
bool ConvexContacts::isTrusted(float separation, float outside) const {
  return limits_.trusts(separation) || (separation < 0 && outside > 0);
}

bool ConvexContacts::isOfContact(float separation, const NearestPoint& nearest) {
  if (separation > limits_.maxSeparation) return false;
  const Vec3 middle = surface_->toPair * surface_->patches().box().middle();
  if (isTrusted(separation, dot(nearest.normal, middle - nearest.point))) return true;
  isDeep_ = true;
  return false;
}

// How far a neighbour may be on the body's side of the tangent plane. Along a flat face all neighbours are equally
// near. A round body turns another normal to a neighbour, so there the nearer of the two touches.
float ConvexContacts::allowedBelow(const Vec3& normal, std::uint32_t neighbour, float separation, float away) {
  const bool isFlat = isSameNormal(seen(neighbour).nearest.normal, normal);
  return isFlat || separation < 0 ? limits_.belowAt(separation, away) : tuning::kBeside * limits_.contactDistance;
}

void ConvexContacts::appendVertex(std::uint32_t vertex) {
  const Seen here = seen(vertex);
  const float separation = separationOf(here.nearest.distance);
  if (!isOfContact(separation, here.nearest)) return;
  const SurfaceFeatures& features = surface_->features();
  for (const std::uint32_t edge : features.edgesAround(vertex)) {
    const std::uint32_t neighbour = features.across(edge, vertex);
    const Vec3 toNeighbour = seen(neighbour).place - here.place;
    if (-dot(here.nearest.normal, toNeighbour) >
        allowedBelow(here.nearest.normal, neighbour, separation, length(toNeighbour)))
      return;
  }
  contacts_.push_back({here.place - here.nearest.normal * (0.5F * separation + surfaceMargin_), here.nearest.normal,
                       separation, FeatureKind::vertexOnFace, vertex, 0});
}

// Along a line the distance from a convex body is a convex function, and the body's supporting planes bound it from
// below. The next sample is where the planes of two samples meet, until no room is left between them. If a face of the
// body is parallel to the line, a whole stretch is equally near.
ConvexContacts::Stretch ConvexContacts::nearestStretch(const Seen& from, const Seen& to) {
  const Vec3 edgeVector = to.place - from.place;
  const auto nearestAt = [&](float at) { return body_->nearest(from.place + edgeVector * at); };
  const auto slopeOf = [&](const NearestPoint& nearest) { return dot(nearest.normal, edgeVector); };
  const float flat = kSameDirection * length(edgeVector);
  Stretch stretch{0, from.nearest};
  if (slopeOf(to.nearest) <= flat) {
    stretch = {1, to.nearest};
  } else if (slopeOf(from.nearest) < -flat) {
    Stretch falls{0, from.nearest}, rises{1, to.nearest};
    for (int i = 0; i < tuning::kMaxIterations; ++i) {
      const float fall = slopeOf(falls.nearest), rise = slopeOf(rises.nearest);
      const float cut =
          (rises.nearest.distance - falls.nearest.distance + fall * falls.at - rise * rises.at) / (fall - rise);
      stretch.at = std::clamp(cut, falls.at, rises.at);
      stretch.nearest = nearestAt(stretch.at);
      const float slope = slopeOf(stretch.nearest),
                  lowerBound = falls.nearest.distance + fall * (stretch.at - falls.at);
      if (std::abs(slope) <= flat) break;
      if (stretch.nearest.distance - lowerBound <= limits_.rounding()) {
        meet(falls.nearest, rises.nearest, edgeVector, from.place + edgeVector * stretch.at, stretch.nearest);
        break;
      }
      (slope < 0 ? falls : rises) = stretch;
    }
  }
  stretch.first = stretch.last = stretch.at;
  if (separationOf(stretch.nearest.distance) > limits_.maxSeparation) return stretch;
  const float maxDistance = stretch.nearest.distance + tuning::kBeside * limits_.contactDistance;
  const auto isOfFace = [&](const NearestPoint& nearest) {
    return nearest.distance <= maxDistance && isSameNormal(nearest.normal, stretch.nearest.normal);
  };
  const auto isOfFaceAt = [&](float at) { return isOfFace(nearestAt(at)); };
  stretch.first = isOfFace(from.nearest) ? 0 : endOf(stretch.at, 0, isOfFaceAt);
  stretch.last = isOfFace(to.nearest) ? 1 : endOf(stretch.at, 1, isOfFaceAt);
  return stretch;
}

// The line passes an edge of the body between two faces: gives the edge's normal across the line. Inside the body the
// distance along this normal is larger than along the faces'. Opposite faces give no normal, because the line goes
// through the body.
void ConvexContacts::meet(const NearestPoint& falls, const NearestPoint& rises, const Vec3& edgeVector,
                          const Vec3& place, NearestPoint& nearest) {
  const float fall = -dot(falls.normal, edgeVector), rise = dot(rises.normal, edgeVector);
  const Vec3 between = (falls.normal * rise + rises.normal * fall) * (1 / (fall + rise));
  if (between == Vec3()) return;
  nearest.normal = unitVector(between);
  if (nearest.distance < 0) nearest.distance = float(nearest.distance / length(Vec3d(between)));
  nearest.point = place - nearest.normal * nearest.distance;
}

void ConvexContacts::appendEdge(std::uint32_t index) {
  const SurfaceEdge& edge = surface_->features().edges()[index];
  const Seen from = seen(edge.vertex[0]), to = seen(edge.vertex[1]);
  const Vec3 edgeVector = to.place - from.place;
  const float least = 0.5F * (from.nearest.distance + to.nearest.distance - length(edgeVector));
  if (separationOf(least) > limits_.maxSeparation) return;
  const Stretch stretch = nearestStretch(from, to);
  if (!isOfContact(separationOf(stretch.nearest.distance), stretch.nearest)) return;
  // An edge's ends are vertices, and `appendVertex` reports those.
  const auto appendAt = [&](float at, const NearestPoint& nearest, std::uint32_t which) {
    if (at > 0 && at < 1) appendOnEdge(index, from.place + edgeVector * at, nearest, which);
  };
  const bool isOnePoint = (stretch.last - stretch.first) * length(edgeVector) < limits_.contactDistance;
  if (isOnePoint) return appendAt(stretch.at, stretch.nearest, 0);
  appendAt(stretch.first, body_->nearest(from.place + edgeVector * stretch.first), 1);
  appendAt(stretch.last, body_->nearest(from.place + edgeVector * stretch.last), 2);
}

void ConvexContacts::appendOnEdge(std::uint32_t index, const Vec3& point, const NearestPoint& nearest,
                                  std::uint32_t which) {
  const SurfaceEdge& edge = surface_->features().edges()[index];
  const float separation = separationOf(nearest.distance);
  const Vec3 along = seen(edge.vertex[1]).place - seen(edge.vertex[0]).place;
  for (const std::uint32_t v : edge.opposite) {
    if (v == SurfaceEdge::kNone) continue;
    const Vec3 toNeighbour = seen(v).place - point;
    const Vec3 beside = toNeighbour - along * (dot(toNeighbour, along) / lengthSq(along));
    if (-dot(nearest.normal, beside) > allowedBelow(nearest.normal, v, separation, length(beside))) return;
  }
  contacts_.push_back({point - nearest.normal * (0.5F * separation + surfaceMargin_), nearest.normal, separation,
                       FeatureKind::edgeOnEdge, index, which});
}

// A point of a triangle is at most the longest side, divided by the root of three, from its nearest corner.
bool ConvexContacts::isFaceSeparated(std::uint32_t index) {
  constexpr float kFarthest = std::numbers::inv_sqrt3_v<float>;
  const auto& [a, b, c] = surface_->mesh.triangles[index];
  const Seen at = seen(a), bt = seen(b), ct = seen(c);
  const float nearest = std::min({at.nearest.distance, bt.nearest.distance, ct.nearest.distance});
  const float longestSq =
      std::max({lengthSq(bt.place - at.place), lengthSq(ct.place - bt.place), lengthSq(at.place - ct.place)});
  return separationOf(nearest) > limits_.maxSeparation + limits_.rounding() + kFarthest * std::sqrt(longestSq);
}

void ConvexContacts::appendFace(std::uint32_t index) {
  const SurfaceFace& face = surface_->features().faces()[index];
  if (face.normal == Vec3() || isFaceSeparated(index)) return;
  const Vec3 outward = surface_->directionToPair(face.normal);
  const Vec3 on = surface_->toPair * surface_->vertex(surface_->mesh.triangles[index][0]);
  const Vec3 lowest = body_->support(-outward);
  if (!isTrusted(separationOf(dot(outward, lowest - on)), dot(outward, middleOfBody_ - on))) return;
  if (facingAlong_ != outward) {
    facing_.look(-outward, limits_.size, [&](const Vec3& direction) { return body_->support(direction); });
    facingAlong_ = outward;
  }
  appendOnFace(index, lowest, outward, 0);
  std::uint32_t corner = 1;
  for (const Vec3& onBody : facing_.corners()) appendOnFace(index, onBody, outward, corner++);
}

void ConvexContacts::appendOnFace(std::uint32_t index, const Vec3& onBody, const Vec3& outward, std::uint32_t corner) {
  const SurfaceFace& face = surface_->features().faces()[index];
  const Vec3 inMesh = surface_->fromPair(onBody);
  const float height = (dot(face.normal, inMesh) - face.offset) * surface_->scale;
  const float separation = separationOf(height);
  if (separation > limits_.maxSeparation) return;
  if (!isOverFace(index, inMesh, separation)) return;
  contacts_.push_back(
      {onBody - outward * (0.5F * separation), -outward, separation, FeatureKind::faceOnVertex, index, corner});
}

// An overlapping point may lie beside the face. Beyond a concave side it may be at any distance. Beyond a convex side
// it may be as far as its depth, if it is still inside the body.
bool ConvexContacts::isOverFace(std::uint32_t index, const Vec3& inMesh, float separation) {
  const SurfaceFace& face = surface_->features().faces()[index];
  if (isOver(face, *surface_, index, inMesh, 0)) return true;
  const float beside = limits_.besideAt(separation) / surface_->scale;
  if (separation >= -limits_.contactDistance) return isOver(face, *surface_, index, inMesh, beside);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool isPast = dot(face.inward[k], inMesh) - face.inwardOffset[k] < -beside;
    if (isPast && !isConcave(*surface_, index, k, limits_.rounding() / surface_->scale)) return false;
  }
  return ray_.isInside(surface_->mesh, inMesh);
}

// Whether a contact's overlap remains when the surface moves out along `other` and a little more.
bool ConvexContacts::staysInside(const FeatureContact& contact, const FeatureContact& other) {
  const float more = tuning::kExplainedSlack * limits_.contactDistance;
  const Vec3 displacement = other.normal * (std::max(-other.separation, 0.0F) + more);
  if (contact.kind != FeatureKind::faceOnVertex) {
    const Vec3 onSurface = contact.position + contact.normal * (0.5F * contact.separation);
    return body_->nearest(onSurface + displacement).distance < 0;
  }
  const Vec3 onBody = contact.position - contact.normal * (0.5F * contact.separation);
  return ray_.isInside(surface_->mesh, surface_->fromPair(onBody - displacement));
}

}  // namespace cairn::bullet
