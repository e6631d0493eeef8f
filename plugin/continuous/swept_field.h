// SPDX-License-Identifier: Zlib
#pragma once

#include "colliders/distance_field.h"
#include "continuous/swept_target.h"

namespace cairn::bullet {

/// A signed distance field as a sweep's target: one element. A body near it meets the plane that touches its surface
/// there.
class SweptField final : public SweptTarget {
 public:
  void take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) override;
  float radius(std::uint32_t element) const override;
  /// Advances by steps as long as the field allows.
  std::optional<float> entry(const Sphere& ball, std::uint32_t element, const Vec3& displacement) const override;
  /// Of the half-space behind the plane that `appendNormals` found last.
  Vec3 support(std::uint32_t element, const Vec3& direction) const override;
  void appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) override;
  void name(std::uint32_t /*element*/, Contact& /*contact*/) const override {}

 private:
  DistanceField field_;
  Vec3 normal_, onPlane_;
};

}  // namespace cairn::bullet
