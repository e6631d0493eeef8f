// SPDX-License-Identifier: Zlib
#pragma once

#include <unordered_map>
#include <vector>

#include "cairn/effects/effect.h"
#include "cairn/effects/fragments.h"

namespace cairn::effects {

/// A breakable body that was struck hard enough.
struct Break {
  btRigidBody* body = nullptr;
  std::uint32_t bodyId = 0;
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
/// `breakOff`, put these into the world and the old one away. What they inherit is the motion after the blow, so energy
/// never rises by breaking. A body breaks at most once a step.
class Fragmentation final : public Effect, ImpactHook {
 public:
  struct Options {
    btScalar energyPerMass = 0;        ///< J/kg, >= 0
    std::uint32_t maxGenerations = 3;  ///< pieces of pieces: a body that comes from so many breaks stays whole
  };

  explicit Fragmentation(const Options& options) : options_(options) {}

  std::string_view name() const override { return "fragmentation"; }
  Hooks hooks() override { return {.impact = this}; }
  void dismiss(Body& body) override;

  /// From now on this body of the set may break; bodies of one piece stay whole.
  void setBreakable(std::uint32_t bodyId, FragmentPart part, std::uint32_t generation = 0);
  /// Null for a body that may not break.
  const FragmentPart* partOf(std::uint32_t bodyId) const;

  /// Those since they were last taken, in the order of the blows.
  std::vector<Break> takeBreaks() { return std::exchange(breaks_, {}); }

 private:
  struct Breakable {
    FragmentPart part;
    std::uint32_t generation;
  };

  std::uint32_t afterImpacts(std::span<const Impact> impacts, const Step& step) override;
  bool strike(const Body& body, const Impact& impact);

  Options options_;
  std::unordered_map<std::uint32_t, Breakable> breakable_;  // by body id; looked up, never walked through
  std::vector<Break> breaks_;
};

}  // namespace cairn::effects
