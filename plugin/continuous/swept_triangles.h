// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "continuous/swept_target.h"
#include "continuous/swept_triangle.h"
#include "triangles/triangle_soup.h"

namespace cairn::bullet {

/// The triangles of any concave shape as a sweep's target, both sides alike; one element each.
class SweptTriangles final : public SweptTarget {
 public:
  void take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) override;
  std::uint32_t rootCount() const override { return static_cast<std::uint32_t>(elements_.size()); }
  float radius(std::uint32_t element) const override;
  std::optional<float> entry(const Sphere& ball, std::uint32_t element, const Vec3& displacement) const override;
  Vec3 support(std::uint32_t element, const Vec3& direction) const override;
  void appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) override;
  void name(std::uint32_t element, Contact& contact) const override;

 private:
  TriangleSoup soup_;
  std::vector<SweptTriangle> elements_;
};

}  // namespace cairn::bullet
