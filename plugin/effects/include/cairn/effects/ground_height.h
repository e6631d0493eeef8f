// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btScalar.h>

#include <optional>

#include "cairn/core/export.h"

namespace cairn::effects {

/// How high the ground is, for effects that act near it. z is up.
class GroundHeight {
 public:
  virtual ~GroundHeight() = default;
  /// z of the ground at a place, world frame, m; nothing where there is none. Asked for bodies in every step; must not
  /// allocate.
  virtual std::optional<btScalar> at(btScalar x, btScalar y) const = 0;
};

/// A ground of constant height.
class LevelGround final : public GroundHeight {
 public:
  /// Ground at this z everywhere, m.
  explicit LevelGround(btScalar height) : height_(height) {}
  std::optional<btScalar> at(btScalar /*x*/, btScalar /*y*/) const override { return height_; }

 private:
  btScalar height_;
};

}  // namespace cairn::effects
