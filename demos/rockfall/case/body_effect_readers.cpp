// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of effects on single bodies, and on bodies that hit something.
#include "rockfall/case/effect_readers.h"

namespace cairn::rockfall {

EffectOptions readGyroscopic(Object& object, const Materials& /*materials*/) {
  return GyroscopicOptions{object.numberOr("min_inertia_ratio", between(1, 1000), 1.05)};
}

EffectOptions readCcd(Object& object, const Materials& /*materials*/) {
  return CcdOptions{object.numberOr("radii_per_step", {0, 100, true}, 0.5)};
}

EffectOptions readSleeping(Object& object, const Materials& /*materials*/) {
  SleepingOptions options;
  options.linearMPerS = object.at("linear_m_per_s").number(between(0, 100));
  options.angularRadPerS = object.at("angular_rad_per_s").number(between(0, 100));
  options.afterS = object.at("after_s").number(between(0, 3600));
  return options;
}

EffectOptions readFragmentation(Object& object, const Materials& /*materials*/) {
  FragmentationOptions options;
  options.energyJPerKg = object.at("energy_j_per_kg").number(between(0, 1e9));
  options.maxGenerations = static_cast<std::uint32_t>(object.at("max_generations").whole(1, 8));
  return options;
}

EffectOptions readEvents(Object& object, const Materials& /*materials*/) {
  const auto dust = object.find("dust_impulse_n_s"), sound = object.find("sound_impulse_n_s");
  if (!dust && !sound) object.refuse("\"dust_impulse_n_s\" or \"sound_impulse_n_s\" must be given");
  constexpr Range kImpulse{0, 1e12, true};
  return EventsOptions{dust ? dust->number(kImpulse) : 0, sound ? sound->number(kImpulse) : 0};
}

}  // namespace cairn::rockfall
