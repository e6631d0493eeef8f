// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cairn/core/result.h"
#include "cairn/effects/effect_set.h"
#include "cairn/effects/fragmentation.h"
#include "cairn/effects/ground_height.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// The number of times a listed effect acted in a run, and the time it took.
struct EffectReport {
  std::string name;
  std::uint64_t acted = 0;
  double elapsedUs = 0;
};

/// The work of a listed effect in a run, see `effects::Work`.
struct EffectRecord {
  std::string name;
  std::uint64_t acts = 0;  ///< on bodies, contacts or impacts
  double energyTakenJ = 0, impulseNS = 0, torqueImpulseNMS = 0;
};

/// The listed effects of a case in one run's world, and no others. Without friction all surfaces are smooth. Without
/// restitution no rock bounces, without gyroscopic none wobbles, without sleeping none sleeps.
class RunEffects {
 public:
  /// `scene` must outlive the effects, and the effects must end before the world. `run` seeds the effects with random
  /// numbers.
  static Result<std::unique_ptr<RunEffects>> create(const Scene& scene, btDiscreteDynamicsWorld& world,
                                                    std::uint64_t run);

  /// Call it for every body before it enters the world. It switches off Bullet's default effects.
  static void prepare(btRigidBody& body);
  /// Call it once the rock is in the world. Returns the rock's number among the effects' bodies.
  std::uint32_t addRock(btRigidBody& rock, MaterialId material, double volume);
  void addGround(const btRigidBody& ground);
  /// Before it leaves the world.
  void removeRock(btRigidBody& rock) { set_->removeBody(rock); }

  /// Null unless listed.
  effects::Fragmentation* fragmentation() const { return fragmentation_; }
  std::vector<EffectReport> report() const;
  std::vector<EffectRecord> records() const;

 private:
  class GroundBelow final : public effects::GroundHeight {
   public:
    explicit GroundBelow(const Ground& ground) : ground_(ground) {}
    std::optional<btScalar> at(btScalar x, btScalar y) const override;

   private:
    const Ground& ground_;
  };
  class Zones final : public effects::MaterialMap {
   public:
    explicit Zones(const Ground& ground) : ground_(ground) {}
    effects::MaterialId at(const btVector3& place) const override;

   private:
    const Ground& ground_;
  };

  explicit RunEffects(const Scene& scene) : below_(*scene.ground), zones_(*scene.ground) {}

  GroundBelow below_;
  Zones zones_;
  effects::Fragmentation* fragmentation_ = nullptr;
  std::unique_ptr<effects::EffectSet> set_;  // last, so that it goes first
};

}  // namespace cairn::rockfall
