// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"

#include "cairn/effects/effect.h"
#include "cairn/effects/ground_height.h"

namespace cairn::effects {

/// Stops slow rocks near the ground by a constant deceleration (as RockGIS does: within 1 m, below 5 m/s). A body comes
/// to rest after v^2 / (2 deceleration), and never turns round. Spin stays unchanged.
///
/// Criterion: the body moves slower than `below`, and the ball of its volume is less than `within` above the ground.
class CAIRN_EFFECTS_EXPORT GroundDrag final : public Effect, ForceHook {
 public:
  /// Where and how much rocks are braked.
  struct Options {
    btScalar below = 5;         ///< m/s; zero does nothing
    btScalar within = 1;        ///< m, from the ball's underside; zero does nothing
    btScalar deceleration = 0;  ///< m/s^2, >= 0; zero does nothing
  };

  /// `ground` must outlive the effect.
  GroundDrag(const Options& options, const GroundHeight& ground) : options_(options), ground_(ground) {}

  std::string_view name() const override { return "ground_drag"; }
  Turn turn() const override { return Turn::groundDrag; }
  Hooks hooks() override { return {.force = this}; }

 private:
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) override;

  Options options_;
  const GroundHeight& ground_;
};

}  // namespace cairn::effects
