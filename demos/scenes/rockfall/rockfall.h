// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "scenes/rockfall/slope.h"
#include "scenes/world/body_scene.h"

namespace cairn::scenes {

struct RockfallOptions {
  std::uint32_t rocks = 100;
  std::uint64_t seed = 1;                ///< of the slope and of the rocks' orientations and places
  std::uint32_t stepsWithoutBudget = 0;  ///< before the world's budget holds
  WorldOptions world;                    ///< its shape is what the rocks collide as; its time step is the scene's
  ShapeOptions shape;
};

/// Rocks of one model and of 1 kg released above the shelf of a slope, which is a mesh of triangles for every shape.
/// Steps of 1/120 s, because the fastest rocks pass their own radius in 1/60 s.
class Rockfall final : public BodyScene {
 public:
  /// Fails for what the shape or the dispatcher refuses.
  static Result<std::unique_ptr<Rockfall>> create(const Model& model, const RockfallOptions& options);
  ~Rockfall() override;

  static constexpr std::uint32_t kStepsPerSecond = 120;

  const Slope& slope() const { return slope_; }

  /// Rocks whose centre of mass is below the ground or off the map.
  std::uint32_t countLost() const override;
  std::size_t groundParts() const override { return 1; }
  double clearance(const PlacedBody& body, const ExactSurface& surface, std::size_t part) const override;

 private:
  Rockfall(const Model& model, const RockfallOptions& options);
  void addRock(std::uint32_t number, std::uint64_t seed);

  Slope slope_;
};

}  // namespace cairn::scenes
