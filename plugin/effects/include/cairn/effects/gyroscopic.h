// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// The torque a spinning body of uneven inertia exerts on itself, in place of Bullet's: Euler's equations
/// I w' = I w x w in the body's principal axes, by the implicit midpoint rule, which keeps the energy of the spin and
/// the size of the angular momentum (both are quadratic: Hairer, Lubich, Wanner 2006, Geometric Numerical Integration,
/// IV.2), by Newton's method in double precision. Bullet's default loses half of the momentum in a minute at 60 Hz; its
/// explicit form gains energy. The momentum's direction is Bullet's to keep, who turns the body by the new velocity:
/// right to first order of the step.
///
/// Criterion: the ratio of the greatest to the smallest principal moment is at least `minInertiaRatio` when the body
/// comes (those bodies' gyroscopic flags are switched off until they leave; others keep Bullet's), and it spins. Bodies
/// that cannot turn about some axis are left alone.
class CAIRN_EFFECTS_EXPORT Gyroscopic final : public Effect, ForceHook {
 public:
  /// Which bodies it is for.
  struct Options {
    btScalar minInertiaRatio = btScalar(1.05);  ///< >= 1
  };

  /// Precondition: values in their ranges.
  explicit Gyroscopic(const Options& options) : options_(options) {}

  std::string_view name() const override { return "gyroscopic"; }
  Turn turn() const override { return Turn::gyroscopic; }
  Hooks hooks() override { return {.force = this}; }
  void welcome(Body& body) override;
  void dismiss(Body& body) override;

  /// The spin after `time`, in principal axes, no torque acting. Where Newton's method finds none (steps of more than
  /// half a turn): `spin`. Moments in kg m^2, > 0.
  static btVector3 spinAfter(const btVector3& moments, const btVector3& spin, btScalar time);

 private:
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) override;

  struct Taken {
    bool isTaken = false;
    int flags = 0;      // Bullet's, that were switched off
    btVector3 moments;  // when it came
  };

  Options options_;
  std::vector<Taken> taken_;  // by body id
};

}  // namespace cairn::effects
