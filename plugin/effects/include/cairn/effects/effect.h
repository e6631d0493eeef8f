// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "cairn/core/export.h"

#include "cairn/effects/materials.h"

class btCollisionObject;
class btManifoldPoint;
class btRigidBody;

namespace cairn::effects {

/// An object's properties that Bullet does not know.
struct Traits {
  MaterialId material = 0;           ///< of the whole object, where `map` is null
  const MaterialMap* map = nullptr;  ///< in place of `material` where an object has several; must outlive its use
  btScalar volume = 0;               ///< m^3; what buoyancy displaces. Zero: effects that need it pass the body over
};

/// A moving body in an `EffectSet`.
struct CAIRN_EFFECTS_EXPORT Body {
  /// A body of the world that takes part from now on, under this id.
  Body(btRigidBody* rigidBody, const Traits& itsTraits, std::uint32_t itsId);

  btRigidBody* body;  ///< not null; it belongs to the world
  Traits traits;      ///< as it came with
  std::uint32_t id;   ///< given by the set in the order bodies came, never again to another; a place in tables
  btScalar radius;    ///< m, of the ball of the volume it came with
};

/// One simulation step, as its hooks see it.
struct Step {
  btScalar timeStep = 0;     ///< s
  btVector3 gravity;         ///< m/s^2, the world's
  std::uint64_t number = 0;  ///< counted by the set from zero
};

/// One of the two objects of a contact or an impact.
struct Side {
  const btCollisionObject* object = nullptr;  ///< not null in a contact or an impact
  const Body* body = nullptr;                 ///< null for what does not move or was not added
  MaterialId material = 0;                    ///< at the contact
};

/// A point of a manifold before the solver sees it; both sides' materials are known.
struct Contact {
  btManifoldPoint* point = nullptr;  ///< Bullet's own, for what is changed
  std::array<Side, 2> sides;         ///< in the order of the manifold's bodies
  btVector3
      relativeVelocity;       ///< of side 0's surface against side 1's, there, forces of this step but gravity included
  btScalar closingSpeed = 0;  ///< m/s along the point's normal; positive where the surfaces approach
  std::int32_t impact = -1;   ///< which of this step's pairs it belongs to if they may strike each other, else -1
  btScalar distance = 0;      ///< m, from collision detection; negative where the surfaces overlap
  /// Whether its blow is to act where bodies touch first: set by what gives it friction. See
  /// docs/algorithms/effects.md.
  bool ordersBlow = false;
  ///@{
  /// Resistance to rolling and to spinning about the normal: torques of at most these lengths times the normal force,
  /// m. Zero in every step until an effect says otherwise. An effect that does gets their work by `Answer::rolling`;
  /// see `EffectSet::canAct` for the solvers that can.
  btScalar rollingLength = 0;
  btScalar spinningLength = 0;
  ///@}
};

/// A blow between two objects: all their contacts in all manifolds together. Bullet takes two steps to stop bodies that
/// are about to touch. Such a blow is reported once, when it is over, with the motion before it began.
struct CAIRN_EFFECTS_EXPORT Impact {
  std::array<Side, 2> sides;               ///< the two objects; at least one of them moves
  btVector3 place;                         ///< of the contact that closed fastest, world frame
  btVector3 normal;                        ///< there, unit, from side 1 to side 0
  btVector3 relativeVelocity;              ///< there, before: of side 0 against side 1
  btScalar closingSpeed = 0;               ///< before, m/s, positive
  btScalar impulse = 0;                    ///< sum of the normal impulses, N s
  std::array<btVector3, 2> linearBefore;   ///< of the centres of mass; zero for what does not move
  std::array<btVector3, 2> angularBefore;  ///< rad/s, world frame

  /// 1/2 m v^2 of the closing speed with the two masses' reduced mass, J: what the blow can spend.
  btScalar energy() const;
};

/// Acts on velocities before the solver does, so that contacts answer in the same step. Bodies that sleep are left out.
/// Returns on how many bodies it acted.
class ForceHook {
 public:
  virtual ~ForceHook() = default;
  /// Changes velocities of the bodies that are awake; returns on how many it acted.
  virtual std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) = 0;
};

/// Changes friction, restitution or normals of contacts. Contacts between two sleeping objects are left out. Returns
/// the number of contacts changed. The change must not depend on a change in an earlier step, because Bullet keeps
/// points.
class CAIRN_EFFECTS_EXPORT MaterialHook {
 public:
  virtual ~MaterialHook() = default;
  /// Whether it might change contacts of these materials, in either order; those that no effect is concerned with it
  /// need not be shown. Always the same answer.
  virtual bool concerns(MaterialId /*a*/, MaterialId /*b*/) const { return true; }
  /// Changes how these contacts answer; returns on how many it acted.
  virtual std::uint32_t changeContacts(std::span<Contact> contacts, const Step& step) = 0;
  /// After the solver, for what must not stay changed.
  virtual void restoreContacts(std::span<Contact> /*contacts*/) {}
};

/// Acts on velocities after the solver, before bodies are moved. Returns on how many impacts it acted.
class ImpactHook {
 public:
  virtual ~ImpactHook() = default;
  /// As `MaterialHook::concerns`, of impacts.
  virtual bool concerns(MaterialId /*a*/, MaterialId /*b*/) const { return true; }
  /// Changes velocities of the bodies that were struck; returns on how many impacts it acted.
  virtual std::uint32_t afterImpacts(std::span<const Impact> impacts, const Step& step) = 0;
};

/// Observes impacts after all effects have acted on them; changes nothing in the world. Returns the number of impacts
/// recorded.
class EventHook {
 public:
  virtual ~EventHook() = default;
  /// Takes note of impacts; returns of how many.
  virtual std::uint32_t noteImpacts(std::span<const Impact> impacts, const Step& step) = 0;
};

/// The part of a contact that a material hook controls, for the pairs it is concerned with: the work there is booked to
/// it. Where several hooks control it, the last by their turns counts.
enum class Answer : std::uint8_t { none, friction, restitution, rolling };

/// Where an effect wants to be asked; null: not there, and costs nothing there.
struct Hooks {
  ForceHook* force = nullptr;        ///< before the solver, for velocities
  MaterialHook* material = nullptr;  ///< before the solver, for contacts
  ImpactHook* impact = nullptr;      ///< after the solver, for velocities
  EventHook* event = nullptr;        ///< after all others, to take note
  Answer answer = Answer::none;      ///< of the material hook
};

/// When an effect acts in each of its hooks, first to last; those of one turn in the order they were added. So the
/// order in which a scene lists effects of different kinds decides nothing.
enum class Turn : std::uint8_t {
  // Media, the widest first; then what goes by the speed they leave.
  airDrag,
  water,
  forestDrag,
  trees,
  barrier,
  groundDrag,
  gyroscopic,
  continuousCollision,
  sleeping,
  // A value before what replaces it; a normal before what goes by the speed along it; all before what ends friction.
  friction,
  slipFriction,
  surfaceRoughness,
  restitution,
  rollingResistance,
  tangentialRestitution,
  // The part of a blow that one effect leaves is what the next can take or break.
  soilScarring,
  fragmentation,
  events,
  others,  ///< those that are not of this library
};

/// One effect of a scene, which acts through its hooks on whatever meets its criterion.
class CAIRN_EFFECTS_EXPORT Effect {
 public:
  virtual ~Effect() = default;
  /// The effect's name in reports and case files. Valid as long as the effect.
  virtual std::string_view name() const = 0;
  /// When the effect acts beside others. Always the same answer.
  virtual Turn turn() const { return Turn::others; }
  /// Asked once, when it is added to a set.
  virtual Hooks hooks() = 0;
  /// A body has come into the set (or was there before the effect): the place to switch on what Bullet does itself.
  virtual void welcome(Body& /*body*/) {}
  /// A body leaves the set; it still lives.
  virtual void dismiss(Body& /*body*/) {}
};

}  // namespace cairn::effects
