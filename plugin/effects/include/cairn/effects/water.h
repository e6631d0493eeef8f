// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"
#include "cairn/effects/region.h"

namespace cairn::effects {

/// Still water below a level, of a part of the map or everywhere; z is up. Taken for the ball of its volume about its
/// centre of mass, a body is submerged by the fraction f its cap below the level has, h^2 (3 r - h) / (4 r^3). It gets
/// * buoyancy, density volume f against gravity (Archimedes),
/// * drag, F = 1/2 density coefficient pi r^2 f v^2 against its motion, solved for the step as `AirDrag`'s is.
/// Both act at the centre of mass and turn nothing; the water that moves along (added mass) and the blow of landing are
/// left out. A body sinks to (m - density volume) g = F, or floats where f = m / (density volume).
///
/// Criterion: has a volume, its ball reaches below the level, and its centre is in the region.
class CAIRN_EFFECTS_EXPORT Water final : public Effect, ForceHook {
 public:
  /// The water, and the bodies' shape in it.
  struct Options {
    btScalar level = 0;                    ///< z of the surface, m
    btScalar density = 1000;               ///< kg/m^3, >= 0
    btScalar coefficient = btScalar(0.5);  ///< >= 0
    Region region = {};                    ///< where it is
  };

  /// Precondition: values in their ranges.
  explicit Water(Options options) : options_(std::move(options)) {}

  std::string_view name() const override { return "water"; }
  Turn turn() const override { return Turn::water; }
  Hooks hooks() override { return {.force = this}; }

  /// Of a ball's volume, in [0, 1], when its centre is so far below the surface (m; negative: above).
  static btScalar submergedFraction(btScalar radius, btScalar depth);

 private:
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) override;

  Options options_;
};

}  // namespace cairn::effects
