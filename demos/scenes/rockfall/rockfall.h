// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cairn/bullet/sphere_tree_shape.h"
#include "scenes/rockfall/slope.h"
#include "scenes/world/world.h"

namespace cairn::scenes {

struct RockfallOptions {
  std::uint32_t rocks = 100;
  std::uint64_t seed = 1;
  bullet::StepBudget budget;
};

/// Rocks released above the shelf of a slope: a few distinct trees, each rock at its own size (0.4 to 1.1 m across) and
/// mass (2600 kg/m^3), orientation and place. Steps of 1/120 s, because the fastest rocks pass their own radius in 1/60
/// s.
class Rockfall {
 public:
  /// `trees` are shared out in turn. Fails for what the shapes or the dispatcher refuse. Precondition: at least one
  /// tree.
  static Result<std::unique_ptr<Rockfall>> create(std::span<const std::shared_ptr<const SphereTree>> trees,
                                                  const RockfallOptions& options);

  static constexpr std::uint32_t kStepsPerSecond = 120;

  StepRecord step() { return world_->step(); }
  const World& world() const { return *world_; }
  const Slope& slope() const { return slope_; }

  /// Rocks whose centre of mass is below the ground or off the map.
  std::uint32_t countLost() const;

 private:
  explicit Rockfall(const RockfallOptions& options);
  Status addRock(std::uint32_t number, std::shared_ptr<const SphereTree> tree, std::uint64_t seed);

  Slope slope_;
  std::vector<std::unique_ptr<bullet::SphereTreeShape>> shapes_;
  std::unique_ptr<World> world_;  // last, so that it goes first
};

}  // namespace cairn::scenes
