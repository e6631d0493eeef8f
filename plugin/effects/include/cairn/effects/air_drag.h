// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Drag of still air at high Reynolds numbers: F = 1/2 density coefficient A v^2 against the motion of the centre of
/// mass, A = pi r^2 of the ball of the body's volume (Rayleigh's law; a ball's coefficient is 0.47, a cube's about 1:
/// Hoerner 1965, Fluid-Dynamic Drag). The step's own solution, v / (1 + k v t) with k = F / (m v^2), so nothing turns
/// round however long the step. Spin is left alone.
///
/// Criterion: has a volume, and is faster than `leastSpeed`. For a rock of 1 m at 30 m/s it is 1.4 % of its weight.
class CAIRN_EFFECTS_EXPORT AirDrag final : public Effect, ForceHook {
 public:
  /// The air, and the bodies' shape in it.
  struct Options {
    btScalar density = btScalar(1.2);      ///< kg/m^3, >= 0
    btScalar coefficient = btScalar(0.5);  ///< >= 0
    btScalar leastSpeed = 0;               ///< m/s
  };

  /// Precondition: values in their ranges.
  explicit AirDrag(const Options& options) : options_(options) {}

  std::string_view name() const override { return "air_drag"; }
  Turn turn() const override { return Turn::airDrag; }
  Hooks hooks() override { return {.force = this}; }

 private:
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) override;

  Options options_;
};

}  // namespace cairn::effects
