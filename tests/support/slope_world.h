// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <stdexcept>
#include <utility>

#include "bullet_world.h"
#include "cairn/effects/effect_set.h"
#include "effect_materials.h"

namespace cairn::test {

/// A world with a set of effects and one ground, a plane through the origin that leans down along +x.
class SlopeWorld {
 public:
  explicit SlopeWorld(btScalar slopeRadians = 0, btScalar stepsPerSecond = 240)
      : step_(1 / stepsPerSecond),
        ground_(bullet.add(
            std::make_shared<btStaticPlaneShape>(btVector3(btSin(slopeRadians), 0, btCos(slopeRadians)), btScalar(0)),
            0, btVector3(0, 0, 0))) {
    auto created = effects::EffectSet::create(bullet.world);
    if (!created) throw std::runtime_error(created.error().message);
    set_ = std::move(created).value();
    set_->describe(ground_, {.material = kSoil});
    ground_.setFriction(1);
    bullet.world.setGravity(btVector3(0, 0, -kGravity));
  }

  /// A body of rock that never sleeps.
  btRigidBody& addBody(std::shared_ptr<btCollisionShape> shape, btScalar mass, const btVector3& position,
                       btScalar volume = 0) {
    btRigidBody& body = bullet.add(std::move(shape), mass, position);
    body.setActivationState(DISABLE_DEACTIVATION);
    set_->addBody(body, {.material = kRock, .volume = volume});
    return body;
  }

  template <class EffectType, class... Arguments>
  EffectType& add(Arguments&&... arguments) {
    auto effect = std::make_unique<EffectType>(std::forward<Arguments>(arguments)...);
    EffectType& added = *effect;
    set_->add(std::move(effect));
    return added;
  }

  void run(btScalar seconds) {
    const int steps = static_cast<int>(seconds / step_ + btScalar(0.5));
    for (int i = 0; i < steps; ++i) runStep();
  }
  void runStep() { bullet.world.stepSimulation(step_, 1, step_); }

  btScalar stepLength() const { return step_; }
  effects::EffectSet& set() { return *set_; }
  const btRigidBody& ground() const { return ground_; }

  BulletWorld<> bullet;

 private:
  btScalar step_;
  btRigidBody& ground_;
  std::unique_ptr<effects::EffectSet> set_;  // last, so that it goes first
};

inline btScalar radians(btScalar degrees) {
  return degrees * SIMD_RADS_PER_DEG;
}

}  // namespace cairn::test
