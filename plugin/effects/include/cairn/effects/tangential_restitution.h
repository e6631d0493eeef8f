// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Lumped tangential restitution, for comparison with tools that know points only: a bounce leaves a body the table's
/// part Rt of the velocity its centre had along the surface, and no friction acts in it. (As friction it would be an
/// angle of atan((1 - Rt) / Rt).) A part of 1 is off: such pairs keep their friction.
///
/// A *bounce* is the first blow after a free flight. A body flies from the step in which it last touched anything to
/// that in which it touches again. A flight counts if the body could have fallen through its radius meanwhile,
/// t >= sqrt(2 r / g): a hop of a quarter of the radius on level ground. So a rock that tumbles from corner to corner
/// rolls, with friction. What an experiment measured of a bounce is not taken at every corner. A body without a volume
/// is a point: each of its blows but those that follow a touch is one. Of several blows in one step the first counts.
///
/// Only against static objects; moving bodies that strike each other keep their friction. Energy never rises.
class CAIRN_EFFECTS_EXPORT TangentialRestitution final : public Effect, MaterialHook, ImpactHook {
 public:
  /// Of a fall from rest that takes as long as the shortest free flight, in radii of the body.
  static constexpr btScalar kFallenRadii = 1;

  /// Parts in [0, 1].
  explicit TangentialRestitution(PairTable<btScalar> parts);

  std::string_view name() const override { return "tangential_restitution"; }
  Turn turn() const override { return Turn::tangentialRestitution; }
  Hooks hooks() override { return {.material = this, .impact = this}; }
  void welcome(Body& body) override;

 private:
  struct Flight {
    std::uint64_t touched = 0;  // the number of the step in which it last touched, or came
    bool bounces = false;       // in a blow that began with a bounce and goes on
  };
  struct Changed {
    btManifoldPoint* point;
    btScalar friction, rolling, spinning;
  };

  // All contacts, if any: those of other pairs end flights too.
  bool concerns(MaterialId /*a*/, MaterialId /*b*/) const override { return acts_; }
  std::uint32_t changeContacts(std::span<Contact> contacts, const Step& step) override;
  void restoreContacts(std::span<Contact> contacts) override;
  std::uint32_t afterImpacts(std::span<const Impact> impacts, const Step& step) override;
  // The body that would bounce there, or null.
  const Body* bouncerOf(const std::array<Side, 2>& sides) const;
  bool mayBounce(const Body& body) const;

  PairTable<btScalar> parts_;
  bool acts_;
  Step step_;
  std::vector<Flight> flights_;  // by body id
  std::vector<Changed> changed_;
};

}  // namespace cairn::effects
