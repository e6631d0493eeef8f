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

/// The contacts of a surface with a convex body: a face is touched by what the body turns towards it, an edge where the
/// body is nearest along it, a vertex by the body's nearest point, each only along directions in its own cone of
/// normals. A is the surface; features of B say which of several points it is on one edge or face.
class ConvexContacts {
 public:
  /// Nothing when the budget does not cover it, or where they overlap deeper than local minima are trusted and the
  /// body's middle is outside; where it is inside, the body is told its nearest way out. Valid until the next call.
  /// `limits.margins` count what the body's own margin adds. Frame: the pair's; world lengths. Charges an operation for
  /// each box and each feature that is near, not the rays. Source: see docs/algorithms/convex-contacts.md.
  std::optional<std::span<const FeatureContact>> find(const PlacedSurface& surface, ConvexBody& body,
                                                      const ContactLimits& limits, float surfaceMargin, Budget& budget);

 private:
  // A vertex of the surface in the pair frame, and the body's point nearest to it.
  struct Seen {
    Vec3 place;
    NearestPoint nearest;
  };
  // Of an edge: how far along it the body is nearest, and from where to where the same face of it is as near.
  struct Stretch {
    float at = 0;
    NearestPoint nearest;
    float first = 0, last = 0;
  };

  void begin(const PlacedSurface& surface, ConvexBody& body, const ContactLimits& limits, float surfaceMargin);
  bool listPatches(Budget& budget);
  bool isSwallowed();
  void tellWayOut();
  Vec3 nearestOnSurface(const Vec3& inMesh);
  bool isNear(const Box& box);
  void appendOf(const SurfacePatch& patch);
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
  static void meet(const NearestPoint& falls, const NearestPoint& rises, const Vec3& way, const Vec3& place,
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
  Vec3 facingAlong_;  // what it looked at last; zero: nothing
  std::vector<FeatureContact> contacts_, shallow_;
  SurfaceRay ray_;
};

}  // namespace cairn::bullet
