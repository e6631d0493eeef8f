// SPDX-License-Identifier: Zlib
#include "cairn/effects/impact_events.h"

namespace cairn::effects {
namespace {

std::int64_t idOf(const Side& side) {
  return side.body != nullptr ? std::int64_t(side.body->id) : -1;
}

}  // namespace

std::uint32_t ImpactEvents::noteImpacts(std::span<const Impact> impacts, const Step& step) {
  std::uint32_t noted = 0;
  const auto note = [&](Kind kind, btScalar threshold, const Impact& impact) {
    if (!(impact.impulse > threshold)) return;
    const Side &a = impact.sides[0], &b = impact.sides[1];
    events_.add({kind,
                 impact.place,
                 impact.impulse,
                 impact.closingSpeed,
                 {a.material, b.material},
                 {idOf(a), idOf(b)},
                 step.number});
    ++noted;
  };
  for (const Impact& impact : impacts) {
    note(Kind::dust, options_.dustImpulse, impact);
    note(Kind::sound, options_.soundImpulse, impact);
  }
  return noted;
}

}  // namespace cairn::effects
