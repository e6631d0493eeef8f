// SPDX-License-Identifier: Zlib
#pragma once

#include <variant>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// How much of the closing speed v a blow gives back.
namespace restitution {

/// The table's value e, whatever the speed.
struct Constant {};
/// e / (1 + (v / halfSpeed)^2): the table's value for slow blows, half of it at `halfSpeed` (Pfeiffer and Bowen 1989;
/// their 30 feet per second).
struct Pfeiffer {
  btScalar halfSpeed = btScalar(9.144);  ///< m/s
};
/// halfSpeed / (v + halfSpeed), the table giving half speeds, m/s (Bourrier and Hungr 2011).
struct Bourrier {};

/// Which of the laws holds.
using Law = std::variant<Constant, Pfeiffer, Bourrier>;

/// The coefficient at a closing speed (m/s, >= 0). `value`: the table's.
btScalar at(const Law& law, btScalar value, btScalar closingSpeed);

}  // namespace restitution

/// Restitution by pair of materials and by closing speed, for shapes of every kind, whatever the step: Bullet's own
/// makes a bounce lower the shorter the step is, because it subtracts what is left of the way at full step speed; here
/// points tell the solver a distance that leaves the speed alone (see docs/algorithms/effects.md).
///
/// Bodies' own restitution is overridden. Bounces below `EffectSet::kImpactSpeed` end.
class CAIRN_EFFECTS_EXPORT Restitution final : public Effect, MaterialHook {
 public:
  /// `values` mean what `law` says of the table.
  Restitution(PairTable<btScalar> values, restitution::Law law) : values_(std::move(values)), law_(law) {}

  std::string_view name() const override { return "restitution"; }
  Turn turn() const override { return Turn::restitution; }
  Hooks hooks() override { return {.material = this, .answer = Answer::restitution}; }

 private:
  std::uint32_t changeContacts(std::span<Contact> contacts, const Step& step) override;

  PairTable<btScalar> values_;
  restitution::Law law_;
};

}  // namespace cairn::effects
