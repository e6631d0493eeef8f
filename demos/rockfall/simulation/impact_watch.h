// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <vector>

#include "rockfall/simulation/rock_watch.h"

namespace cairn::rockfall {

/// Detects impacts. A rock without a contact in the step before gets an impulse that changes its speed by at least half
/// a metre a second. In an impact between two rocks, each records its own side.
class ImpactWatch {
 public:
  /// Both arguments must outlive this object.
  ImpactWatch(const Scene& scene, RunResult& result) : scene_(scene), result_(result), touched_(result.rocks.size()) {}

  /// Adds a rock that the result already has. It touches the same bodies as the rock it broke from.
  void addRock(std::uint32_t brokenFrom) { touched_.push_back(touched_[brokenFrom]); }
  /// Call it after every step, while `watch` still has the moments before the step. `rocks` is by number, null for
  /// rocks that are not in the world.
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
