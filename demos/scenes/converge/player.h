// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cairn/core/result.h"
#include "scenes/world/world.h"

namespace cairn::scenes {

/// Looks for collisions in recorded frames with one kind of shape.
class Player {
 public:
  virtual ~Player() = default;

  /// Forgets all frames so far; another run follows.
  virtual Status begin() = 0;
  /// Plays one frame with one motion for each body. The recorded cost is the narrow phase alone.
  virtual StepRecord show(std::span<const BodyMotion> motions) = 0;
  /// Returns the contacts of the last frame.
  virtual std::vector<ReportedContact> contacts() const = 0;
};

/// Makes a player for any shape, `world.shape`. Fails when the shape or the dispatcher refuses its options, and in one
/// sentence for a shape whose library this build lacks.
Result<std::unique_ptr<Player>> makePlayer(const Model& model, std::uint32_t bodies, const WorldOptions& world,
                                           const ShapeOptions& shape);

/// Makes a player for the Flexible Collision Library on the same triangles: BVHModel of OBBRSS. It calls `collide` for
/// every pair of meshes with overlapping boxes. The limit of contacts per pair is that of a Bullet manifold; `collide`
/// stops there, which is cheap for deep overlaps. The time excludes the boxes. Fails in a build without FCL.
Result<std::unique_ptr<Player>> makeFclPlayer(const Model& model);

}  // namespace cairn::scenes
