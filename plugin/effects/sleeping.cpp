// SPDX-License-Identifier: Zlib
#include "cairn/effects/sleeping.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace cairn::effects {

void Sleeping::welcome(Body& known) {
  if (states_.size() <= known.id) states_.resize(known.id + 1);
  btRigidBody& body = *known.body;
  const bool isKeptAwake = body.getActivationState() == DISABLE_DEACTIVATION;
  states_[known.id] = {body.getLinearSleepingThreshold(), body.getAngularSleepingThreshold(), isKeptAwake, 0};
  body.setSleepingThresholds(options_.linear, options_.angular);
  if (isKeptAwake) body.forceActivationState(ACTIVE_TAG);
  body.setDeactivationTime(0);
  ++bodies_;
}

void Sleeping::dismiss(Body& known) {
  const State& state = states_[known.id];
  known.body->setSleepingThresholds(state.linear, state.angular);
  if (state.wasKeptAwake) known.body->forceActivationState(DISABLE_DEACTIVATION);
  --bodies_;
}

// A body's clock stands at zero when a step begins. After it, Bullet adds the step to the clock of a slow body and asks
// whether more than its own time is up.
std::uint32_t Sleeping::applyForces(std::span<Body* const> bodies, const Step& step) {
  for (const Body* known : bodies) {
    State& state = states_[known->id];
    btRigidBody& body = *known->body;
    state.quiet = body.getDeactivationTime() > 0 ? state.quiet + step.timeStep : btScalar(0);
    body.setDeactivationTime(state.quiet + step.timeStep > options_.after ? gDeactivationTime : btScalar(0));
  }
  return static_cast<std::uint32_t>(bodies_ - bodies.size());
}

}  // namespace cairn::effects
