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

/// The contacts of a tree with one of Bullet's meshes, surface against surface, where that is a solid and the body
/// outside of it.
class MeshGround {
 public:
  /// What of the mesh is near the tree.
  struct Near {
    const btConcaveShape& shape;
    const TriangleSoup& soup;
    std::span<const Triangle> inPair;  ///< the soup's, in the pair frame
  };

  void reset();
  /// Whether `append` can tell the contacts. Notes when the body comes near, and whether it is inside then: to be told
  /// in each step. False for what is no solid, inside of one (rooms, and what came so fast that most of it is through
  /// the surface), and once triangles change.
  bool watch(const PairPlacement& placement, const Near& near);
  /// See `Collider::appendOfMesh`. Precondition: `watch` said so in this step.
  std::optional<float> append(const MeshQuestion& question, const PairPlacement& placement, const Near& near,
                              std::vector<Contact>& contacts);
  /// Where in the soup a triangle is that a contact of the last answer was told with.
  static std::uint32_t inSoup(const TriangleSoup& soup, const Contact& contact);

 private:
  enum class Place : std::uint8_t { away, outside, inside };

  SurfacePair surfacesOf(const PairPlacement& placement) const;
  bool isInside(const PairPlacement& placement);
  bool isStillTheShapes(const TriangleSoup& soup) const;
  ContactId idOf(const Near& near, const FeatureContact& contact) const;

  std::shared_ptr<const GroundSurface> surface_;
  bool hasChanged_ = false;  // the mesh, since its surface was made
  Place place_ = Place::away;
  KernelMemory memory_;
  SurfaceRay ray_;
};

}  // namespace cairn::bullet
