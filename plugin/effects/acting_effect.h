// SPDX-License-Identifier: Zlib
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "cairn/effects/effect_set.h"

namespace cairn::effects {

/// An effect in a set, with what it did and what that took.
class ActingEffect {
 public:
  explicit ActingEffect(std::unique_ptr<Effect> effect) : effect_(std::move(effect)), hooks_(effect_->hooks()) {
    report_.name = effect_->name();
  }

  Effect& effect() { return *effect_; }
  const Hooks& hooks() const { return hooks_; }
  const EffectReport& report() const { return report_; }

  /// On how many it acted, as `afterImpacts`.
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) {
    return hooks_.force == nullptr ? 0 : timed([&] { return hooks_.force->applyForces(bodies, step); });
  }
  void changeContacts(std::span<Contact> contacts, const Step& step) {
    if (hooks_.material != nullptr) timed([&] { return hooks_.material->changeContacts(contacts, step); });
  }
  void restoreContacts(std::span<Contact> contacts) {
    if (hooks_.material != nullptr) hooks_.material->restoreContacts(contacts);
  }
  std::uint32_t afterImpacts(std::span<const Impact> impacts, const Step& step) {
    return hooks_.impact == nullptr ? 0 : timed([&] { return hooks_.impact->afterImpacts(impacts, step); });
  }
  /// Whether it has this say on contacts of two materials.
  bool answers(Answer answer, MaterialId a, MaterialId b) const {
    return hooks_.answer == answer && hooks_.material->concerns(a, b);
  }
  void book(const Work& work) { report_.work += work; }
  void noteImpacts(std::span<const Impact> impacts, const Step& step) {
    if (hooks_.event != nullptr) timed([&] { return hooks_.event->noteImpacts(impacts, step); });
  }

 private:
  template <class Act>
  std::uint32_t timed(const Act& act) {
    const auto start = std::chrono::steady_clock::now();
    const std::uint32_t acted = act();
    report_.elapsedMicroseconds +=
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    report_.acted += acted;
    if (acted > 0) ++report_.stepsActed;
    return acted;
  }

  std::unique_ptr<Effect> effect_;
  Hooks hooks_;
  EffectReport report_;
};

}  // namespace cairn::effects
