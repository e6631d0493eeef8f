// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/energy_watch.h"

#include <algorithm>

#include "scenes/world/world.h"

namespace cairn::rockfall {

double EnergyWatch::energyOf(const btRigidBody& body) const {
  const auto height = static_cast<double>(body.getWorldTransform().getOrigin().z()) - lowestHeight_;
  return scenes::kineticEnergy(body) + gravity_ * height / static_cast<double>(body.getInvMass());
}

double& EnergyWatch::of(std::uint32_t rock) {
  if (rock >= energies_.size()) energies_.resize(rock + 1, 0.0);
  return energies_[rock];
}

void EnergyWatch::enter(std::uint32_t rock, const btRigidBody& body) {
  const double energy = of(rock) = energyOf(body);
  total_ += energy;
  least_ += energy;
  brought_ += energy;
}

void EnergyWatch::leave(std::uint32_t rock) {
  const double energy = std::exchange(of(rock), 0.0);
  total_ -= energy;
  least_ -= energy;
}

void EnergyWatch::follow(std::uint32_t rock, const btRigidBody& body) {
  double& energy = of(rock);
  total_ -= energy;
  energy = energyOf(body);
  total_ += energy;
}

void EnergyWatch::endStep() {
  least_ = std::min(least_, total_);
  rise_ = std::max(rise_, total_ - least_);
}

}  // namespace cairn::rockfall
