// SPDX-License-Identifier: Zlib
#pragma once

#include "colliders/convex_surface.h"
#include "continuous/swept_target.h"

namespace cairn::bullet {

/// Any convex shape as a sweep's target: one element, near when its box is entered.
class SweptConvex final : public SweptTarget {
 public:
  void take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) override;
  float radius(std::uint32_t element) const override;
  std::optional<float> entry(const Sphere& ball, std::uint32_t element, const Vec3& displacement) const override;
  Vec3 support(std::uint32_t /*element*/, const Vec3& direction) const override { return surface_.support(direction); }
  void appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) override;
  void name(std::uint32_t /*element*/, Contact& /*contact*/) const override {}

 private:
  ConvexSurface surface_;
  Vec3 lower_, upper_;
};

}  // namespace cairn::bullet
