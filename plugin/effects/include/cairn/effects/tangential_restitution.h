// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Lumped tangential restitution, for comparison with tools that know points only: a blow leaves a body the table's
/// part of the velocity its centre had along the surface, and no friction acts in it. (As friction it would be an angle
/// of atan((1 - Rt) / Rt).) Takes the place of friction in blows, not in rest.
///
/// Only against what does not move; two bodies that strike each other keep their friction. Energy never rises.
class TangentialRestitution final : public Effect, MaterialHook, ImpactHook {
 public:
  /// Parts in [0, 1].
  explicit TangentialRestitution(PairTable<btScalar> parts) : parts_(std::move(parts)) {}

  std::string_view name() const override { return "tangential_restitution"; }
  Turn turn() const override { return Turn::tangentialRestitution; }
  Hooks hooks() override { return {.material = this, .impact = this}; }

 private:
  std::uint32_t changeContacts(std::span<Contact> contacts, const Step& step) override;
  std::uint32_t afterImpacts(std::span<const Impact> impacts, const Step& step) override;

  PairTable<btScalar> parts_;
};

}  // namespace cairn::effects
