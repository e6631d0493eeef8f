// SPDX-License-Identifier: Zlib
#pragma once

#include "continuous/swept_target.h"
#include "placement/placed_tree.h"

namespace cairn::bullet {

/// Another sphere-tree; elements are its nodes.
class SweptTree final : public SweptTarget {
 public:
  void take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) override;
  Children children(std::uint32_t element) const override;
  float radius(std::uint32_t element) const override { return tree_.sphere(element).radius; }
  float margin() const override { return margin_; }
  std::optional<float> entry(const Sphere& ball, std::uint32_t element, const Vec3& way) const override;
  Vec3 support(std::uint32_t element, const Vec3& direction) const override {
    return tree_.support(element, direction);
  }
  void appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) override;
  void name(std::uint32_t element, ContactId& id) const override;

 private:
  PlacedTree tree_;
  float margin_ = 0;
};

/// The normals of a node's faces, where it has any; else the middle of its normals, where it lies in a plane. Both
/// ways: what is behind a flat region is apart from it along the opposite.
void appendFaces(const PlacedTree& tree, NodeId node, SeparatingNormals& normals);

}  // namespace cairn::bullet
