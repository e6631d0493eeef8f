// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "scenes/rockfall/slope.h"
#include "scenes/world/body_scene.h"

namespace cairn::scenes {

struct RockfallOptions {
  std::uint32_t rocks = 100;
  std::uint64_t seed = 1;                ///< for the slope and the rocks' orientations and places
  std::uint32_t stepsWithoutBudget = 0;  ///< steps before the world's budget applies
  WorldOptions world;                    ///< its shape is the rocks' shape; the scene sets its time step
  ShapeOptions shape;
};

/// Rocks of one model and of 1 kg, released above the shelf of a slope. The slope is a mesh of triangles for every
/// shape. Steps take 1/120 s, because the fastest rocks travel their own radius in 1/60 s.
class Rockfall final : public BodyScene {
 public:
  /// Fails when the shape or the dispatcher refuses its options.
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
