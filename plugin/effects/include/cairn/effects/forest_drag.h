// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"
#include "cairn/effects/ground_height.h"
#include "cairn/effects/region.h"

namespace cairn::effects {

/// A forest as a layer that brakes: F = -coefficient v while the centre of mass is less than `height` above the ground
/// (the forest damping of RAMMS::ROCKFALL and RocFall, after Leine et al. 2014). The step's own solution,
/// v exp(-coefficient t / m): left alone, a body stops after m v / coefficient. Spin is left alone.
///
/// Criterion: moves, is in the region, below the height, over known ground.
class CAIRN_EFFECTS_EXPORT ForestDrag final : public Effect, ForceHook {
 public:
  /// The forest.
  struct Options {
    btScalar height = 10;      ///< m above ground; zero does nothing
    btScalar coefficient = 0;  ///< kg/s, >= 0; zero does nothing
    Region region = {};        ///< where it stands
  };

  /// `ground` must outlive the effect.
  ForestDrag(Options options, const GroundHeight& ground) : options_(std::move(options)), ground_(ground) {}

  std::string_view name() const override { return "forest_drag"; }
  Turn turn() const override { return Turn::forestDrag; }
  Hooks hooks() override { return {.force = this}; }

 private:
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) override;

  Options options_;
  const GroundHeight& ground_;
};

}  // namespace cairn::effects
