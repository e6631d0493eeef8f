// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/energy_watch.h"

#include <algorithm>
#include <cmath>

#include "scenes/world/world.h"

namespace cairn::rockfall {
namespace {

bool exchangesImpulses(const btPersistentManifold& manifold) {
  for (int i = 0; i < manifold.getNumContacts(); ++i)
    if (manifold.getContactPoint(i).getAppliedImpulse() > 0) return true;
  return false;
}

}  // namespace

double EnergyWatch::energyOf(const btRigidBody& body) const {
  const auto height = static_cast<double>(body.getWorldTransform().getOrigin().z()) - lowestHeight_;
  return scenes::kineticEnergy(body) + gravity_ * height / static_cast<double>(body.getInvMass());
}

EnergyWatch::Rock& EnergyWatch::of(std::uint32_t rock) {
  while (rocks_.size() <= rock) rocks_.push_back({.met = static_cast<std::uint32_t>(rocks_.size())});
  return rocks_[rock];
}

void EnergyWatch::enter(std::uint32_t rock, const btRigidBody& body) {
  of(rock).before = of(rock).now = energyOf(body);
  brought_ += of(rock).now;
}

void EnergyWatch::follow(std::uint32_t rock, const btRigidBody& body) {
  of(rock).now = energyOf(body);
}

void EnergyWatch::handOn(std::uint32_t rock, std::uint32_t piece) {
  of(rock).now = 0;
  meet(rock, piece);
}

std::uint32_t EnergyWatch::groupOf(std::uint32_t rock) const {
  while (rocks_[rock].met != rock) rock = rocks_[rock].met;
  return rock;
}

void EnergyWatch::meet(std::uint32_t rock, std::uint32_t other) {
  of(std::max(rock, other));
  rocks_[groupOf(rock)].met = groupOf(other);
}

void EnergyWatch::lookAt(const btCollisionDispatcher& dispatcher) {
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold =
        *const_cast<btCollisionDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    const int rock = manifold.getBody0()->getUserIndex(), other = manifold.getBody1()->getUserIndex();
    if (rock >= 0 && other >= 0 && exchangesImpulses(manifold))
      meet(static_cast<std::uint32_t>(rock), static_cast<std::uint32_t>(other));
  }
}

// A rock alone has the whole of its gain or loss: the quotient is one.
void EnergyWatch::endStep() {
  const auto gainOf = [](const Rock& rock) { return rock.now - rock.before; };
  for (std::uint32_t rock = 0; rock < rocks_.size(); ++rock) {
    const double gain = gainOf(rocks_[rock]);
    Rock& group = rocks_[groupOf(rock)];
    (gain > 0 ? group.gains : group.losses) += std::abs(gain);
  }
  for (std::uint32_t i = 0; i < rocks_.size(); ++i) {
    Rock& rock = rocks_[i];
    const Rock& group = rocks_[groupOf(i)];
    const double gain = gainOf(rock), same = gain > 0 ? group.gains : group.losses;
    const double opposite = gain > 0 ? group.losses : group.gains;
    if (same > opposite) rock.risen = std::max(0.0, rock.risen + gain * ((same - opposite) / same));
    rise_ = std::max(rise_, rock.risen);
  }
  for (std::uint32_t i = 0; i < rocks_.size(); ++i)
    rocks_[i] = {.before = rocks_[i].now, .now = rocks_[i].now, .risen = rocks_[i].risen, .met = i};
}

}  // namespace cairn::rockfall
