// SPDX-License-Identifier: Zlib
#pragma once

#include <limits>

#include "cairn/core/export.h"
#include "cairn/effects/bounded_log.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Tells a game where to draw dust and play sounds: blows whose normal impulse is greater than a threshold. Changes
/// nothing.
class CAIRN_EFFECTS_EXPORT ImpactEvents final : public Effect, EventHook {
 public:
  /// Which blows are told.
  struct Options {
    btScalar dustImpulse = std::numeric_limits<btScalar>::infinity();   ///< N s; infinity: none
    btScalar soundImpulse = std::numeric_limits<btScalar>::infinity();  ///< N s; infinity: none
    std::size_t kept = 1024;  ///< events that wait to be taken; beyond it the oldest are dropped and counted
  };
  /// What a game makes of a blow. One blow may be both.
  enum class Kind : std::uint8_t { dust, sound };
  /// A blow above a threshold.
  struct Event {
    Kind kind;                            ///< dust or sound
    btVector3 place;                      ///< world frame
    btScalar impulse;                     ///< N s
    btScalar closingSpeed;                ///< m/s
    std::array<MaterialId, 2> materials;  ///< in the order of the impact's sides
    std::array<std::int64_t, 2> bodyIds;  ///< in the set; -1 for what does not move
    std::uint64_t step;                   ///< its number
  };

  /// Makes room for `kept` events at once.
  explicit ImpactEvents(const Options& options) : options_(options), events_(options.kept) {}

  std::string_view name() const override { return "events"; }
  Turn turn() const override { return Turn::events; }
  Hooks hooks() override { return {.event = this}; }

  /// Those since this was last asked, in the order of their steps.
  BoundedLog<Event>& events() { return events_; }

 private:
  std::uint32_t noteImpacts(std::span<const Impact> impacts, const Step& step) override;

  Options options_;
  BoundedLog<Event> events_;
};

}  // namespace cairn::effects
