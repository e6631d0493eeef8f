// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Bodies slower than two thresholds for some time fall asleep, island by island, and cost nothing until something
/// wakes them: Bullet's own sleeping, with these thresholds, for bodies that may have been kept from it
/// (`DISABLE_DEACTIVATION`). When a body leaves, it has its own thresholds and is kept from sleep again if it was.
///
/// Bullet's time is one for all worlds of a program, `gDeactivationTime`. It is left alone: the time is measured here,
/// and a body's clock is put forward to Bullet's when it is up. So worlds may differ, and nothing sleeps where
/// `gDeactivationTime` is zero, which in Bullet means never. A scene without this effect lets bodies sleep or not as it
/// likes.
///
/// Counts the bodies of the set that are asleep.
class CAIRN_EFFECTS_EXPORT Sleeping final : public Effect, ForceHook {
 public:
  /// When bodies fall asleep.
  struct Options {
    btScalar linear = btScalar(0.8);  ///< m/s, >= 0; Bullet's own
    btScalar angular = 1;             ///< rad/s, >= 0; with either at zero nothing sleeps
    btScalar after = 2;               ///< s, >= 0
  };

  /// Precondition: values in their ranges.
  explicit Sleeping(const Options& options) : options_(options) {}

  std::string_view name() const override { return "sleeping"; }
  Turn turn() const override { return Turn::sleeping; }
  Hooks hooks() override { return {.force = this}; }
  void welcome(Body& body) override;
  void dismiss(Body& body) override;

 private:
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) override;

  struct State {
    btScalar linear = 0, angular = 0;  // thresholds it came with
    bool wasKeptAwake = false;
    btScalar quiet = 0;  // s it has been slow
  };

  Options options_;
  std::vector<State> states_;  // by body id
  std::size_t bodies_ = 0;
};

}  // namespace cairn::effects
