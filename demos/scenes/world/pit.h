// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "scenes/world/world.h"

namespace cairn::scenes {

/// A half-space that bodies must not enter: its points p have dot(normal, p) < offset.
struct HalfSpace {
  Vec3d normal;  ///< unit, pointing into the pit
  double offset = 0;
};

/// A square pit: ground at z = 0 and four walls, open above. The inner faces do not depend on the material of `build`.
class Pit {
 public:
  /// `halfWidth` in metres, from the middle to a wall.
  explicit Pit(double halfWidth);

  double halfWidth() const { return halfWidth_; }
  std::array<HalfSpace, 5> faces() const;

  /// Adds the pit to the world, made of shapes that suit the bodies. Trees and GImpact get planes; GImpact is six times
  /// slower on boxes. Hulls and compounds get boxes of `height` metres, because planes give them several times as many
  /// manifolds. The pit must outlive the world.
  void build(World& world, ShapeKind bodies, double height);

 private:
  void addPlanes(World& world);
  void addBoxes(World& world, double height);

  double halfWidth_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
};

}  // namespace cairn::scenes
