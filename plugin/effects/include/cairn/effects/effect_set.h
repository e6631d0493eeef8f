// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/result.h"
#include "cairn/effects/effect.h"

class btDiscreteDynamicsWorld;

namespace cairn::effects {

/// Energies and impulses, summed over bodies.
struct Work {
  double energyTaken = 0;    ///< of their motion, J; negative: given
  double impulse = 0;        ///< size of what changed their momentum, N s
  double torqueImpulse = 0;  ///< and, without that, their angular momentum, N m s

  /// Adds, number by number.
  Work& operator+=(const Work& more) {
    energyTaken += more.energyTaken;
    impulse += more.impulse;
    torqueImpulse += more.torqueImpulse;
    return *this;
  }
};

/// An effect's actions since it was added. Its work is the work of its hooks on velocities. Effects that change
/// contacts get the work of these contacts: friction along the surface, restitution across it, rolling resistance by
/// its torques.
struct EffectReport {
  std::string_view name;           ///< as `Effect::name`
  std::uint64_t acted = 0;         ///< bodies, contacts or impacts it acted on, summed over the steps
  std::uint64_t stepsActed = 0;    ///< steps in which it acted on any
  double elapsedMicroseconds = 0;  ///< in its hooks
  Work work;                       ///< what it did to bodies
};

/// The effects of a scene, and nothing else: what was not added is not there, and a set without effects leaves every
/// bit of a simulation as it is.
///
///     auto made = cairn::effects::EffectSet::create(world);
///     if (!made) return fail(made.error().message);
///     cairn::effects::EffectSet& effects = *made.value();
///     effects.add(std::make_unique<cairn::effects::AirDrag>(options));
///     effects.addBody(rock, {.material = kLimestone, .volume = volume});
///     effects.describe(ground, {.material = kSoil});
///
/// It stands between the world and its solver and is called in every internal step: forces and materials after
/// collision detection and before solving, impacts and events after solving and before bodies move. So it works with
/// any dispatcher and any shapes, and leaves Bullet's tick callbacks and actions to the game. Effects act in the order
/// of their turns (see `Turn`), whichever was added first. No allocation once as many contacts and bodies were seen as
/// there will be.
///
/// **Lifetime.** It must die before the world, and before or after all bodies as you like, if these were removed. While
/// it lives, `world.getConstraintSolver()` is not the solver you made; a solver set since is left alone (asserted).
class CAIRN_EFFECTS_EXPORT EffectSet {
 public:
  /// An error for a world that made its solver itself (it would free it) and for multibody and soft-body worlds, which
  /// keep another one.
  static Result<std::unique_ptr<EffectSet>> create(btDiscreteDynamicsWorld& world);
  ~EffectSet();
  EffectSet(const EffectSet&) = delete;
  EffectSet& operator=(const EffectSet&) = delete;

  /// One sentence why an effect could not do what it says in this world. Resistance to rolling needs a world whose
  /// solver is a `btSequentialImpulseConstraintSolver` itself or an `OrderedSolver` of it. Beside another one Bullet's
  /// own rows resist, which end at the torque of a normal impulse of 1 N s.
  Status canAct(const Effect& effect) const;

  /// Adds an effect; it sees the bodies that are there and all that come. Not from within a hook (asserted).
  void add(std::unique_ptr<Effect> effect);

  /// From now on effects see this body. Precondition: a dynamic body of the world that is not in the set, and volume >=
  /// 0. Returns its id.
  std::uint32_t addBody(btRigidBody& body, const Traits& traits);
  /// Before it leaves the world or dies. Nothing happens to a body that is not in the set. Linear in the bodies. Not
  /// from within a hook (asserted).
  void removeBody(btRigidBody& body);

  /// Says what a thing that effects do not move is made of: ground, walls. Contacts of what was neither added nor
  /// described are no business of the effects. Again: replaces.
  void describe(const btCollisionObject& object, const Traits& traits);
  /// Before it dies.
  void forget(const btCollisionObject& object);

  /// In the order the effects were added.
  std::vector<EffectReport> report() const;

  /// Two objects may strike each other where they close faster than this, m/s; what is slower rests or slides. Bullet's
  /// solver lets nothing bounce below the same speed.
  static constexpr btScalar kImpactSpeed = btScalar(0.2);

 private:
  class Impl;
  explicit EffectSet(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace cairn::effects
