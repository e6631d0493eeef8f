// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bodies.h"

namespace cairn::hard {

struct PileOptions {
  int bodies = 20;
  std::uint64_t seed = 1;
  bool doSleep = false;
  int iterations = 10;
  double timeStep = 1.0 / 60;  ///< seconds
  double friction = 0.5;
  bool inTwoDirections = false;
};

/// Bodies of a kilogram dropped in a column into a square pit of planes, at random orientations, no two touching.
class Pile {
 public:
  Pile(const test::TriedBody& tried, double size, const PileOptions& options);

  void step();
  /// Of translation, turning and height, J; NaN makes it NaN.
  double energy() const;
  double kineticEnergy() const;
  double greatestSpeed() const;
  /// Whose place or velocity is not finite.
  int countInsane() const;
  /// Who left the pit through ground or walls by half the size.
  int countLost() const;
  double halfWidth() const { return halfWidth_; }

  const std::vector<btRigidBody*>& bodies() const { return bodies_; }
  const std::vector<btRigidBody*>& planes() const { return planes_; }
  test::StillWorld& world() { return world_; }

 private:
  test::StillWorld world_;
  double timeStep_, size_, halfWidth_ = 0;
  std::vector<btRigidBody*> planes_, bodies_;
};

/// Of translation and turning, J.
double kineticEnergyOf(const btRigidBody& body);

}  // namespace cairn::hard
