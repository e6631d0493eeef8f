// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

namespace cairn::effects {

/// The velocity after `time` under a deceleration of `k` v^2 (k in 1/m, >= 0), nothing else acting.
inline btVector3 dragged(const btVector3& velocity, btScalar k, btScalar time) {
  return velocity / (1 + k * velocity.length() * time);
}

/// k of 1/2 density coefficient pi r^2 v^2 on a mass.
inline btScalar dragPerMetre(btScalar density, btScalar coefficient, btScalar radius, btScalar inverseMass) {
  return btScalar(0.5) * density * coefficient * SIMD_PI * radius * radius * inverseMass;
}

}  // namespace cairn::effects
