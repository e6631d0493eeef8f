// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

class btCollisionShape;

namespace cairn::effects {

/// Continuous collision for bodies that are fast for their thickness: a body that would move farther in a step than
/// `radiiPerStep` times its inner radius is looked ahead for. Switches on what Bullet has for it, which Bullet and our
/// own narrow phase then apply to fast bodies alone (docs/algorithms/continuous.md): the motion threshold, and for
/// convex shapes the radius of the ball they are swept as, half of the inner radius. Both are given back when the body
/// leaves. Counts the bodies that are fast enough in a step.
///
/// Concave shapes that are not sphere-trees (compounds, GImpact) have no continuous collision in Bullet.
class CAIRN_EFFECTS_EXPORT ContinuousCollision final : public Effect, ForceHook {
 public:
  /// Which bodies are looked ahead for.
  struct Options {
    btScalar radiiPerStep = btScalar(0.5);  ///< >= 0; zero switches nothing on
  };

  /// Precondition: values in their ranges.
  explicit ContinuousCollision(const Options& options) : options_(options) {}

  std::string_view name() const override { return "ccd"; }
  Turn turn() const override { return Turn::continuousCollision; }
  Hooks hooks() override { return {.force = this}; }
  void welcome(Body& body) override;
  void dismiss(Body& body) override;

  /// How thick a shape is at its thickest, m: the largest of a sphere-tree's inner balls, half the least width of the
  /// box of what is not a tree or has none. Linear in a tree's nodes.
  static btScalar innerRadius(const btCollisionShape& shape);

 private:
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) override;

  struct Before {
    btScalar threshold = 0, sweptRadius = 0;
  };

  Options options_;
  std::vector<Before> before_;         // by body id
  std::vector<btScalar> leastSquare_;  // by body id: of the way of a step, m^2
};

}  // namespace cairn::effects
