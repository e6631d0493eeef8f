// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"
#include "cairn/effects/fragments.h"

namespace cairn::effects {

/// A breakable body that was struck hard enough.
struct Break {
  btRigidBody* body = nullptr;   ///< of the set when it was struck
  std::uint32_t bodyId = 0;      ///< its number in the set
  std::uint32_t piece = 0;       ///< that breaks off: the one nearest to where it was struck
  std::uint32_t generation = 0;  ///< how many breaks the body comes from
  btScalar energyPerMass = 0;    ///< of the blow, J/kg
  btVector3 place;               ///< world frame
};

/// Fragmentation (thesis 8.3.5): a blow of more energy per mass of a body than it can take breaks off the branch of its
/// sphere-tree that was struck. The energy is the blow's (`Impact::energy`), so a ball that falls h onto the ground has
/// g h per mass; exactly at the threshold nothing breaks.
///
/// Bodies are not replaced while Bullet works: after `stepSimulation`, take the breaks, make the bodies of each by
/// `breakOff`, put these into the world and the old one away, and tell the effect that they are siblings. What they
/// inherit is the motion after the blow. Siblings touch along their cuts, and their spheres reach beyond these, which
/// Bullet would drive apart the harder the shorter its step is; until they have parted once, their contacts only keep
/// them from coming closer. So energy never rises by breaking. A body breaks at most once a step.
class CAIRN_EFFECTS_EXPORT Fragmentation final : public Effect, MaterialHook, ImpactHook {
 public:
  /// When bodies break.
  struct Options {
    btScalar energyPerMass = 0;        ///< J/kg, >= 0
    std::uint32_t maxGenerations = 3;  ///< pieces of pieces: a body that comes from so many breaks stays whole
  };

  /// Precondition: values in their ranges.
  explicit Fragmentation(const Options& options) : options_(options) {}

  std::string_view name() const override { return "fragmentation"; }
  Turn turn() const override { return Turn::fragmentation; }
  Hooks hooks() override { return {.material = this, .impact = this}; }
  void dismiss(Body& body) override;

  /// From now on this body of the set may break; bodies of one piece stay whole.
  void setBreakable(std::uint32_t bodyId, FragmentPart part, std::uint32_t generation = 0);
  /// The bodies of one break, now in the set. Quadratic in their number, and then in that of their pairs that touch.
  void setSiblings(std::span<const std::uint32_t> bodyIds);
  /// Null for a body that may not break.
  const FragmentPart* partOf(std::uint32_t bodyId) const;

  /// Those since they were last taken, in the order of the blows.
  std::vector<Break> takeBreaks() { return std::exchange(breaks_, {}); }

 private:
  struct Breakable {
    FragmentPart part;
    std::uint32_t generation;
  };

  // Two bodies of one break that have not parted since.
  struct Siblings {
    std::array<std::uint32_t, 2> ids;  // the smaller first
    bool touch = true;                 // in this step
  };

  std::uint32_t changeContacts(std::span<Contact> contacts, const Step& step) override;
  bool holdApart(Contact& contact);
  std::uint32_t afterImpacts(std::span<const Impact> impacts, const Step& step) override;
  bool strike(const Body& body, const Impact& impact);

  Options options_;
  std::unordered_map<std::uint32_t, Breakable> breakable_;  // by body id; looked up, never walked through
  std::vector<Siblings> siblings_;
  std::vector<Break> breaks_;
};

}  // namespace cairn::effects
