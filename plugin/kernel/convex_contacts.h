// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "cairn/core/surface_ray.h"
#include "contacts/facing_corners.h"
#include "kernel/contact_limits.h"
#include "kernel/convex_body.h"
#include "kernel/feature_contacts.h"
#include "memory/stamped_list.h"

namespace cairn::bullet {

/// Finds the contacts of a surface with a convex body. Each feature touches only along directions in its own cone of
/// normals:
///
/// - a face touches the body's corners that face it,
/// - an edge touches where the body is nearest along it,
/// - a vertex touches the body's nearest point.
///
/// A is the surface. The features of B number the points on one edge or face.
///
///     ConvexContacts convexContacts;
///     auto contacts = convexContacts.find(surface, body, limits, surfaceMargin, budget);
///     if (!contacts) return useLeaves();
class ConvexContacts {
 public:
  /// Empty when the budget does not suffice. Empty too when the overlap is deeper than trusted minima and the body's
  /// middle is outside. If the middle is inside, the contacts point along the nearest way out. Valid until the next
  /// call.
  ///
  /// Frame: the pair's; world lengths. `limits.margins` includes the body's own margin. Cost: an operation for each box
  /// and each feature that is near; rays are not charged. Source: docs/algorithms/convex-contacts.md.
  std::optional<std::span<const FeatureContact>> find(const PlacedSurface& surface, ConvexBody& body,
                                                      const ContactLimits& limits, float surfaceMargin, Budget& budget);

 private:
  // A vertex of the surface in the pair frame, and the body's point nearest to it.
  struct Seen {
    Vec3 place;
    NearestPoint nearest;
  };
  // The place along an edge where the body is nearest, and the stretch along which the same face of the body is equally
  // near. All in fractions of the edge.
  struct Stretch {
    float at = 0;
    NearestPoint nearest;
    float first = 0, last = 0;
  };

  void begin(const PlacedSurface& surface, ConvexBody& body, const ContactLimits& limits, float surfaceMargin);
  bool listPatches(Budget& budget);
  bool isSwallowed();
  void appendWayOut();
  Vec3 nearestOnSurface(const Vec3& inMesh);
  bool isNear(const Box& box);
  std::uint64_t costOfPatches() const { return kOverlapTestCost * SurfacePatch::kMaxTriangles * patches_.size(); }
  void appendAll();
  const Seen& seen(std::uint32_t vertex);
  float separationOf(float distance) const { return distance - surfaceMargin_; }
  bool isTrusted(float separation, float outside) const;
  bool isOfContact(float separation, const NearestPoint& nearest);

  void appendVertex(std::uint32_t vertex);
  void appendEdge(std::uint32_t edge);
  void appendFace(std::uint32_t face);
  bool isFaceSeparated(std::uint32_t face);
  bool isOverFace(std::uint32_t face, const Vec3& inMesh, float separation);
  Stretch nearestStretch(const Seen& from, const Seen& to);
  static void meet(const NearestPoint& falls, const NearestPoint& rises, const Vec3& edgeVector, const Vec3& place,
                   NearestPoint& nearest);
  void appendOnEdge(std::uint32_t edge, const Vec3& point, const NearestPoint& nearest, std::uint32_t which);
  void appendOnFace(std::uint32_t face, const Vec3& onBody, const Vec3& normal, std::uint32_t corner);
  float allowedBelow(const Vec3& normal, std::uint32_t neighbour, float separation, float away);
  bool staysInside(const FeatureContact& contact, const FeatureContact& other);

  const PlacedSurface* surface_ = nullptr;
  ConvexBody* body_ = nullptr;
  ContactLimits limits_;
  float surfaceMargin_ = 0;
  Vec3 middleOfBody_;
  bool isDeep_ = false;
  StampedList<Seen> seen_;  // by vertex
  std::vector<std::uint32_t> waiting_, patches_;
  FacingCorners facing_;
  Vec3 facingAlong_;  // the direction `facing_` searched last; zero: none
  std::vector<FeatureContact> contacts_, shallow_;
  SurfaceRay ray_;
};

}  // namespace cairn::bullet
