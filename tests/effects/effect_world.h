// SPDX-License-Identifier: Zlib
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "bullet_world.h"
#include "cairn/effects/effect_set.h"
#include "effect_materials.h"

namespace cairn::test {

inline btScalar ballVolume(btScalar radius) {
  return btScalar(4) / 3 * SIMD_PI * radius * radius * radius;
}

/// Of all the body's motion, J.
inline btScalar kineticEnergy(const btRigidBody& body) {
  const btVector3 spin = body.getAngularVelocity() * body.getCenterOfMassTransform().getBasis();
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  btScalar twice = body.getMass() * body.getLinearVelocity().length2();
  for (int i = 0; i < 3; ++i) twice += spin[i] * spin[i] / inverse[i];
  return twice / 2;
}

/// A world with a set of effects. Nothing is damped and nothing sleeps.
struct EffectWorld {
  template <class EffectType, class... Arguments>
  EffectType& effect(Arguments&&... arguments) {
    auto owned = std::make_unique<EffectType>(std::forward<Arguments>(arguments)...);
    EffectType& effect = *owned;
    set->add(std::move(owned));
    return effect;
  }
  btRigidBody& join(btRigidBody& body, btScalar volume, effects::MaterialId material = 0) {
    body.setActivationState(DISABLE_DEACTIVATION);
    set->addBody(body, {.material = material, .volume = volume});
    return body;
  }
  btRigidBody& ball(btScalar radius, btScalar mass, const btVector3& place, const btVector3& velocity) {
    btRigidBody& body = bullet.add(std::make_shared<btSphereShape>(radius), mass, place);
    body.setLinearVelocity(velocity);
    return join(body, ballVolume(radius));
  }
  /// Level, through the origin.
  btRigidBody& ground(effects::MaterialId material) {
    btRigidBody& body = bullet.addGround();
    set->describe(body, {.material = material});
    return body;
  }
  void step(int count, btScalar time) {
    for (int i = 0; i < count; ++i) bullet.world.stepSimulation(time, 1, time);
  }
  /// How often the only effect acted.
  std::uint64_t acted() const { return set->report().front().acted; }

  BulletWorld<> bullet;
  std::unique_ptr<effects::EffectSet> set = effects::EffectSet::create(bullet.world).value();
};

}  // namespace cairn::test
