// SPDX-License-Identifier: Zlib
#pragma once

#include "continuous/swept_target.h"
#include "continuous/tree_parts.h"

namespace cairn::bullet {

/// Another sphere-tree as a sweep's target; elements are its parts (`TreeParts`).
class SweptTree final : public SweptTarget {
 public:
  void take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) override;
  Children children(std::uint32_t element, float crude) const override;
  float radius(std::uint32_t element) const override { return tree_.sphere(element).radius; }
  float margin() const override { return margin_; }
  std::optional<float> entry(const Sphere& ball, std::uint32_t element, const Vec3& displacement) const override;
  Vec3 support(std::uint32_t element, const Vec3& direction) const override {
    return tree_.support(element, direction);
  }
  void appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) override;
  void name(std::uint32_t element, Contact& contact) const override;

 private:
  TreeParts tree_;
  float margin_ = 0;
};

}  // namespace cairn::bullet
