// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cairn/core/surface_ray.h"
#include "colliders/collider.h"
#include "placement/triangle.h"
#include "triangles/ground_surface.h"

namespace cairn::bullet {

/// The contacts of a tree with one of Bullet's meshes, surface against surface. Works where the mesh is a solid and the
/// body is outside of it.
///
///     if (!ground.watch(placement, near)) return {};
///     return ground.append(question, placement, near, contacts);
class MeshGround {
 public:
  /// The part of the mesh near the tree.
  struct Near {
    const btConcaveShape& shape;
    const TriangleSoup& soup;
    std::span<const Triangle> inPair;  ///< triangles of the soup, in the pair frame
  };

  /// Forgets the mesh, and where the body was.
  void reset();
  /// Whether `append` can find the contacts. Must be called in each step: it records when the body comes near, and
  /// whether it is inside then. False for a mesh that is not a solid, and once triangles change. False for bodies
  /// inside: rooms, and bodies so fast that most of them has passed the surface.
  bool watch(const PairPlacement& placement, const Near& near);
  /// See `Collider::appendOfMesh`. Precondition: `watch` returned true in this step.
  std::optional<float> append(const MeshQuery& question, const PairPlacement& placement, const Near& near,
                              std::vector<Contact>& contacts);
  /// The index in the soup of a contact's triangle. The contact must belong to the last answer.
  static std::uint32_t inSoup(const TriangleSoup& soup, const Contact& contact);

 private:
  enum class Place : std::uint8_t { away, outside, inside };

  SurfacePair surfacesOf(const PairPlacement& placement) const;
  bool isInside(const PairPlacement& placement);
  bool isStillTheShapes(const TriangleSoup& soup) const;
  ContactId idOf(const Near& near, const FeatureContact& contact) const;

  std::shared_ptr<const GroundSurface> surface_;
  bool hasChanged_ = false;  // the mesh has changed since its surface was made
  Place place_ = Place::away;
  KernelMemory memory_;
  SurfaceRay ray_;
};

}  // namespace cairn::bullet
