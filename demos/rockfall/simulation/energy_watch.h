// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <vector>

namespace cairn::rockfall {

/// Watches the mechanical energy of each rock (R13 of the textbook's experiments). Rocks that touch in a step may hand
/// energy to each other, as a rock that breaks does to its pieces. Any other rise from one step to a later one is an
/// error of the simulation, unless water lifted the rock: no other effect adds energy. Heights count from the ground's
/// lowest point. Joules.
class EnergyWatch {
 public:
  EnergyWatch(double gravityMPerS2, double lowestM) : gravity_(gravityMPerS2), lowestHeight_(lowestM) {}

  /// Adds a released rock; its energy is no rise.
  void enter(std::uint32_t rock, const btRigidBody& body);
  /// Updates a rock's energy after a step. What is not updated, as sleeping rocks and those that have left, stays as it
  /// is.
  void follow(std::uint32_t rock, const btRigidBody& body);
  /// The rock broke, and this is one of its pieces: all its energy is theirs in the step that ends next.
  void handOn(std::uint32_t rock, std::uint32_t piece);
  /// These two rocks touch in the step that ends next.
  void meet(std::uint32_t rock, std::uint32_t other);
  /// All rocks between which impulses were exchanged. Rocks are the bodies with a user index of at least 0.
  void lookAt(const btCollisionDispatcher& dispatcher);
  /// Call it after the last rock of a step. Linear in the rocks so far.
  void endStep();

  /// Energy of all released rocks.
  double broughtJ() const { return brought_; }
  /// The most by which the energy of one rock rose above an earlier value. Of rocks that touch, what the gains are more
  /// than the losses is shared among those that gain, in proportion.
  double greatestRiseJ() const { return rise_; }

 private:
  struct Rock {
    double before = 0, now = 0;    // at the ends of the last step and of this one
    double risen = 0;              // above its least energy so far
    double gains = 0, losses = 0;  // in this step, of all rocks that `met` leads to this one
    std::uint32_t met = 0;         // a rock it touches in this step, or itself
  };

  double energyOf(const btRigidBody& body) const;
  Rock& of(std::uint32_t rock);
  std::uint32_t groupOf(std::uint32_t rock) const;

  double gravity_, lowestHeight_;
  std::vector<Rock> rocks_;
  double brought_ = 0, rise_ = 0;
};

}  // namespace cairn::rockfall
