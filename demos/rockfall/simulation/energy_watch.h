// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace cairn::rockfall {

/// Watches the mechanical energy of all rocks together (R13 of the textbook's experiments). No effect adds energy, so
/// any rise from one step to a later one is an error of the simulation. Heights count from the ground's lowest point.
/// Joules.
class EnergyWatch {
 public:
  EnergyWatch(double gravityMPerS2, double lowestM) : gravity_(gravityMPerS2), lowestHeight_(lowestM) {}

  /// Adds a released rock; its energy is no rise.
  void enter(std::uint32_t rock, const btRigidBody& body);
  /// Removes a rock that broke; its energy is that of its pieces, which are followed from now on.
  void handOn(std::uint32_t rock) { total_ -= std::exchange(of(rock), 0.0); }
  /// Removes a rock that has left, with its energy at the last step.
  void leave(std::uint32_t rock);
  /// Updates a rock's energy after a step. Sleeping rocks need no further updates.
  void follow(std::uint32_t rock, const btRigidBody& body);
  /// Call it after the last rock of a step.
  void endStep();

  /// Energy of all released rocks.
  double broughtJ() const { return brought_; }
  /// Largest rise of the energy above an earlier value.
  double greatestRiseJ() const { return rise_; }

 private:
  double energyOf(const btRigidBody& body) const;
  double& of(std::uint32_t rock);

  double gravity_, lowestHeight_;
  std::vector<double> energies_;  // by rock
  double total_ = 0, least_ = 0, brought_ = 0, rise_ = 0;
};

}  // namespace cairn::rockfall
