// SPDX-License-Identifier: Zlib
#pragma once

#include "continuous/swept_target.h"

namespace cairn::bullet {

/// The half-space behind a plane as a sweep's target: one element.
class SweptPlane final : public SweptTarget {
 public:
  void take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) override;
  float radius(std::uint32_t element) const override;
  std::optional<float> entry(const Sphere& ball, std::uint32_t element, const Vec3& displacement) const override;
  Vec3 support(std::uint32_t element, const Vec3& direction) const override;
  void appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) override;
  void name(std::uint32_t /*element*/, Contact& /*contact*/) const override {}

 private:
  Vec3 normal_;
  float offset_ = 0;
};

}  // namespace cairn::bullet
