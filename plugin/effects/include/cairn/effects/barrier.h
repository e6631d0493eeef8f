// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"
#include "cairn/effects/ground_height.h"

namespace cairn::effects {

/// A rock-fall barrier: a net along a line over the ground, which takes a certain energy. A body whose ball touches the
/// net loses as much kinetic energy as the net can take, once for each meeting, and goes on with the rest in its
/// direction. A body without more energy than that is caught: it stays where it is, fixed for all that meets it, until
/// it leaves the set. Like ETAG 027's, the capacity counts for each rock anew: no net is worn out by those before it.
///
/// A meeting: the ball of the body's volume, on its way in this step, touches the upright face over one of the line's
/// segments, from either side, while its centre is no higher above the ground than the net. It ends when a step goes by
/// without. Nets do not bend here: how far one gives way is not in this effect.
///
/// Criterion: has a volume, moves, and touches the net.
class CAIRN_EFFECTS_EXPORT Barrier final : public Effect, ForceHook {
 public:
  /// A place on the map, world frame, m.
  struct Point {
    btScalar x;  ///< east
    btScalar y;  ///< north
  };
  /// From one post to the next.
  struct Segment {
    Point from;  ///< one post
    Point to;    ///< the next
  };
  /// How high the net is, and what it can take.
  struct Options {
    btScalar height = 0;    ///< above the ground, m, >= 0; zero: nothing
    btScalar capacity = 0;  ///< J, >= 0; zero: nothing
  };

  /// Segments without length take no part. `ground` must outlive the effect.
  Barrier(std::vector<Segment> segments, const GroundHeight& ground, const Options& options);

  std::string_view name() const override { return "barrier"; }
  Turn turn() const override { return Turn::barrier; }
  Hooks hooks() override { return {.force = this}; }
  void welcome(Body& body) override;
  void dismiss(Body& body) override;

 private:
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) override;
  bool isTouched(const Body& body, btScalar timeStep) const;
  bool isTouched(const Segment& segment, const Body& body, btScalar timeStep) const;

  std::vector<Segment> segments_;
  const GroundHeight& ground_;
  Options options_;
  std::vector<bool> meeting_;  // by body id: it touched the net in its last step
};

}  // namespace cairn::effects
