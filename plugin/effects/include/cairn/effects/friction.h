// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Coulomb friction by pair of materials, in place of Bullet's product of the two bodies' coefficients.
class CAIRN_EFFECTS_EXPORT Friction final : public Effect, MaterialHook {
 public:
  /// Coefficients, >= 0.
  explicit Friction(PairTable<btScalar> coefficients) : coefficients_(std::move(coefficients)) {}

  std::string_view name() const override { return "friction"; }
  Turn turn() const override { return Turn::friction; }
  Hooks hooks() override { return {.material = this, .answer = Answer::friction}; }

 private:
  std::uint32_t changeContacts(std::span<Contact> contacts, const Step& step) override;

  PairTable<btScalar> coefficients_;
};

}  // namespace cairn::effects
