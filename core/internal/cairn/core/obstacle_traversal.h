// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/core/traversal.h"

namespace cairn {

/// Something that is not a sphere-tree, seen from one: a plane, a convex shape, a distance field, a soup of triangles.
/// It consists of elements (one for a plane or a field) and answers which spheres of a family an element touches.
class Obstacle {
 public:
  virtual ~Obstacle() = default;

  /// How many elements there are; they are numbered from 0.
  virtual std::uint32_t elementCount() const = 0;
  /// Bit i is set unless lane i of the family is certainly farther than the obstacle's margin from the element. The
  /// family is in the tree's frame and unit; the obstacle knows the pose. Dead lanes (infinite centre) must give 0.
  virtual std::uint32_t touches(const Family& family, std::uint32_t familySize, std::uint32_t element) const = 0;
};

/// Breadth-first traversal of one sphere-tree against an obstacle. A pair is (node, element). A step costs one update
/// of the element and one test per child (Eq. 2.1).
class CAIRN_CORE_EXPORT ObstacleTraversal final : public Traversal {
 public:
  /// Begins anew with the root against every element. `scale` is world length per tree unit. The tree and the obstacle
  /// must outlive the traversal. The root tests are part of starting and are not charged.
  void start(const SphereTree& tree, float scale, const Obstacle& obstacle);

  Progress refine(Budget& budget) override;
  bool mayTouch(const NodePair& pair) const override;
  float pairError(const NodePair& pair) const override;
  float worstOf(std::span<const NodePair> pairs) const override;

 private:
  const SphereTree* tree_ = nullptr;
  const Obstacle* obstacle_ = nullptr;
  float errorScale_ = 1;  // world length per tree unit, grown by `kErrorGrowth`
};

}  // namespace cairn
