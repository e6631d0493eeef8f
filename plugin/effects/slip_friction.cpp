// SPDX-License-Identifier: Zlib
#include "cairn/effects/slip_friction.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>

#include <algorithm>
#include <cmath>

namespace cairn::effects {

void SlipFriction::welcome(Body& body) {
  if (states_.size() <= body.id) states_.resize(body.id + 1);
  slipping_.reserve(states_.size());
}

btScalar SlipFriction::coefficientAt(btScalar slip) const {
  return options_.least + (options_.most - options_.least) * btScalar(2) / SIMD_PI * std::atan(options_.kappa * slip);
}

// A body's slip is carried over to a step when its first contact is met: what happened since is one long flight.
void SlipFriction::noteSlip(const Contact& contact, const Step& step) {
  const btVector3& normal = contact.point->m_normalWorldOnB;
  const btVector3 slip = contact.relativeVelocity - normal * normal.dot(contact.relativeVelocity);
  for (const Side& side : contact.sides) {
    if (side.body == nullptr) continue;
    State& state = states_[side.body->id];
    if (state.seen != step.number + 1) {
      const auto steps = static_cast<btScalar>(step.number - std::min(step.number, state.seen));
      state.slip *= std::exp(-options_.recovery * steps * step.timeStep);
      state.slipSpeed = 0;
      state.seen = step.number + 1;
      slipping_.push_back(side.body->id);
    }
    state.slipSpeed = std::max(state.slipSpeed, slip.length());
  }
}

const SlipFriction::State* SlipFriction::stateOf(const Contact& contact) const {
  const State* most = nullptr;
  for (const Side& side : contact.sides)
    if (side.body != nullptr)
      if (const State& state = states_[side.body->id]; most == nullptr || state.slip > most->slip) most = &state;
  return most;
}

std::uint32_t SlipFriction::changeContacts(std::span<Contact> contacts, const Step& step) {
  const auto touches = [&](const Contact& contact) {
    return concerns(contact.sides[0].material, contact.sides[1].material) && contact.point->getDistance() <= 0;
  };
  slipping_.clear();
  for (const Contact& contact : contacts)
    if (touches(contact)) noteSlip(contact, step);
  // Friction as in the middle of the step's way.
  const auto advance = [&] {
    for (const std::uint32_t id : slipping_) states_[id].slip += states_[id].slipSpeed * step.timeStep / 2;
  };
  advance();
  std::uint32_t acted = 0;
  for (Contact& contact : contacts) {
    if (!concerns(contact.sides[0].material, contact.sides[1].material)) continue;
    contact.ordersBlow = true;
    const State* state = stateOf(contact);
    contact.point->m_combinedFriction = coefficientAt(state != nullptr ? state->slip : btScalar(0));
    ++acted;
  }
  advance();
  return acted;
}

}  // namespace cairn::effects
