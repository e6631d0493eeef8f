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

  /// Forgets all frames shown so far: what comes next is another run.
  virtual Status begin() = 0;
  /// One frame: a motion a body. Its cost is the narrow phase alone.
  virtual StepRecord show(std::span<const BodyMotion> motions) = 0;
  /// What the last frame gave.
  virtual std::vector<ReportedContact> contacts() const = 0;
};

/// `world.shape` says which shape; it may be any. Fails for what shape or dispatcher refuse, and in one sentence for a
/// shape this build has no library for.
Result<std::unique_ptr<Player>> makePlayer(const Model& model, std::uint32_t bodies, const WorldOptions& world,
                                           const ShapeOptions& shape);

/// The Flexible Collision Library on the same triangles: BVHModel of OBBRSS, `collide` with as many contacts a pair as
/// a Bullet manifold holds (it stops there: cheap for bodies deep in each other), for every pair whose meshes' boxes
/// overlap; the boxes are not part of its time. Fails in a build without FCL.
Result<std::unique_ptr<Player>> makeFclPlayer(const Model& model);

}  // namespace cairn::scenes
