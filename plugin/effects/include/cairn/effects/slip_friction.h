// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Friction that grows with the way a body has slipped: mu = least + 2/pi (most - least) atan(kappa s), where s grows
/// by the slip speed while the body touches one of the given pairs of materials and dies away as exp(-recovery t) while
/// it does not. Soil heaps up before a rock and lets it go in the air (Leine et al. 2014, Multibody System Dynamics 32,
/// 241-271). It replaces `Friction`'s value for these pairs, unless `most` is zero, which is off.
class CAIRN_EFFECTS_EXPORT SlipFriction final : public Effect, MaterialHook {
 public:
  /// How friction grows.
  struct Options {
    btScalar least = btScalar(0.2);  ///< coefficient before any slip, >= 0
    btScalar most = 2;               ///< coefficient it grows towards, >= least; zero: off
    btScalar kappa = btScalar(2.5);  ///< 1/m, >= 0
    btScalar recovery = 1;           ///< 1/s, >= 0
  };

  /// `applies`: for which pairs.
  SlipFriction(const Options& options, PairTable<bool> applies) : options_(options), applies_(std::move(applies)) {}

  std::string_view name() const override { return "slip_friction"; }
  Turn turn() const override { return Turn::slipFriction; }
  Hooks hooks() override { return {.material = this, .answer = Answer::friction}; }
  void welcome(Body& body) override;

  /// The coefficient after slipping so far (m). At least `least`, below `most`.
  btScalar coefficientAt(btScalar slip) const;

 private:
  struct State {
    btScalar slip = 0;       // m, as of the last step the body was seen in
    btScalar slipSpeed = 0;  // m/s, the fastest of this step's contacts
    std::uint64_t seen = 0;  // one more than the number of that step
  };

  bool concerns(MaterialId a, MaterialId b) const override { return options_.most > 0 && applies_.at(a, b); }
  std::uint32_t changeContacts(std::span<Contact> contacts, const Step& step) override;
  void noteSlip(const Contact& contact, const Step& step);
  const State* stateOf(const Contact& contact) const;

  Options options_;
  PairTable<bool> applies_;
  std::vector<State> states_;  // by body id
  std::vector<std::uint32_t> slipping_;
};

}  // namespace cairn::effects
