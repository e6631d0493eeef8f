// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cairn/core/result.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// How often a listed effect acted in a run, and what that cost.
struct EffectReport {
  std::string name;
  std::uint64_t acted = 0;
  double cpuUs = 0;
};

/// The effects a case lists, at work in one run's world. Bodies carry their material as Bullet's second user index;
/// the ground's is -1 and its material depends on the place.
class RunEffects {
 public:
  virtual ~RunEffects() = default;
  /// For every rock and for the ground, before it enters the world.
  virtual void prepare(btRigidBody& body) = 0;
  /// In every step between the narrow phase and the solver.
  virtual void afterCollision(btDispatcher& dispatcher) = 0;
  virtual std::vector<EffectReport> report() const = 0;
};

/// Fails in one sentence for an effect this build cannot simulate: nothing listed is left out silently. `scene` must
/// outlive the effects; `run` seeds those that draw numbers.
Result<std::unique_ptr<RunEffects>> makeEffects(const Scene& scene, btDiscreteDynamicsWorld& world, std::uint64_t run);

/// The same question without a world.
Status checkEffects(const Case& description);

}  // namespace cairn::rockfall
