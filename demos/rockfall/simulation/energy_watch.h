// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace cairn::rockfall {

/// Watches the mechanical energy of all rocks together (R13 of the textbook's experiments): nothing gives any to them,
/// so what it rises by from one step to a later one is the simulation's error. Heights count from the ground's lowest
/// point. Joules.
class EnergyWatch {
 public:
  EnergyWatch(double gravityMPerS2, double lowestM) : gravity_(gravityMPerS2), lowestHeight_(lowestM) {}

  /// A rock that was released: what it brings is no rise.
  void enter(std::uint32_t rock, const btRigidBody& body);
  /// It broke: its energy is that of its pieces, which are followed from now on.
  void handOn(std::uint32_t rock) { total_ -= std::exchange(of(rock), 0.0); }
  /// A rock that is gone: it takes along what it had at the last step.
  void leave(std::uint32_t rock);
  /// Its energy after a step. Those that sleep need not be told again.
  void follow(std::uint32_t rock, const btRigidBody& body);
  /// After the last rock of a step.
  void endStep();

  /// Of all that was released.
  double broughtJ() const { return brought_; }
  /// The most by which it has been above what it was at some time before.
  double greatestRiseJ() const { return rise_; }

 private:
  double energyOf(const btRigidBody& body) const;
  double& of(std::uint32_t rock);

  double gravity_, lowestHeight_;
  std::vector<double> energies_;  // by rock
  double total_ = 0, least_ = 0, brought_ = 0, rise_ = 0;
};

}  // namespace cairn::rockfall
