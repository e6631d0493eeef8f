// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <vector>

#include "rockfall/simulation/rock_watch.h"

namespace cairn::rockfall {

/// Notices impacts: a rock that touched nothing in the step before gets an impulse that changes its speed by at least
/// half a metre a second. Every rock of an impact between two records its own side of it.
class ImpactWatch {
 public:
  /// Both must outlive the watch.
  ImpactWatch(const Scene& scene, RunResult& result) : scene_(scene), result_(result), touched_(result.rocks.size()) {}

  /// One more rock, which the result has already; it touches what the rock touched that it broke off from.
  void addRock(std::uint32_t brokenFrom) { touched_.push_back(touched_[brokenFrom]); }
  /// After every step, while `watch` still has the moments before it. `rocks` by number, null for those not in the
  /// world.
  void lookAt(const btCollisionDispatcher& dispatcher, const std::vector<btRigidBody*>& rocks, const RockWatch& watch,
              double timeS);

 private:
  struct Touch {
    double impulseNS = 0;  // over all contacts
    double hardestNS = 0;
    btVector3 place;
    const btCollisionObject* other = nullptr;
  };

  std::vector<Touch> touchesOf(const btCollisionDispatcher& dispatcher) const;
  MaterialId materialOf(const Touch& touch) const;

  const Scene& scene_;
  RunResult& result_;
  std::vector<bool> touched_;
};

}  // namespace cairn::rockfall
