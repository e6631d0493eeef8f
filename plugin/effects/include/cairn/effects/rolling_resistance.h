// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Resistance to rolling and to spinning on the spot: a torque of at most `length` times the normal force, by pair of
/// materials (rolling friction's lever arm, m). A ball of radius r that rolls without slip is slowed by
/// 5/7 * g * length / r, whatever its mass and the step. Takes the place of what the bodies say themselves; where both
/// lengths are zero that stays.
///
/// Bullet's own rolling rows end at the torque of a normal impulse of 1 N s; these are solved by the set, which
/// cannot do that beside every solver of a world (see `EffectSet::canAct`).
class CAIRN_EFFECTS_EXPORT RollingResistance final : public Effect, MaterialHook {
 public:
  /// Lever arms of one pair of materials.
  struct Lengths {
    btScalar rolling = 0;   ///< m, >= 0
    btScalar spinning = 0;  ///< m, >= 0; about the contact's normal
  };

  /// Precondition: lengths >= 0.
  explicit RollingResistance(PairTable<Lengths> lengths) : lengths_(std::move(lengths)) {}

  std::string_view name() const override { return "rolling_resistance"; }
  Turn turn() const override { return Turn::rollingResistance; }
  Hooks hooks() override { return {.material = this, .answer = Answer::rolling}; }

 private:
  bool concerns(MaterialId a, MaterialId b) const override { return acts(lengths_.at(a, b)); }
  std::uint32_t changeContacts(std::span<Contact> contacts, const Step& step) override;

  static bool acts(const Lengths& lengths) { return lengths.rolling > 0 || lengths.spinning > 0; }

  PairTable<Lengths> lengths_;
};

}  // namespace cairn::effects
