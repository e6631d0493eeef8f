// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cairn/core/vec3.h"
#include "rockfall/case/materials.h"
#include "rockfall/simulation/run_effects.h"

namespace cairn::rockfall {

/// The state of a rock at the end of its run.
enum class RockEnd : std::uint8_t {
  resting,  ///< asleep
  moving,   ///< the run's time was over
  left,     ///< it left the ground over its edge
  lost,     ///< all of it was below the ground
  broken,   ///< its pieces go on as rocks of their own
  hole,     ///< it came over a hole of the ground, where the terrain has no heights
};
inline constexpr std::size_t kRockEnds = 6;

/// Energies are kinetic, of translation and rotation. Heights are those of the centre of mass above the ground below
/// it. Places are centres of mass, in the map's coordinates once a run has ended. Times since the run's begin. SI
/// units.
struct RockRecord {
  std::int32_t brokenFrom = -1;  ///< the rock it is a piece of; `start` is where that one was released
  std::uint32_t group = 0, variant = 0;
  double sieveM = 0, massKg = 0, releaseS = 0;
  double endS = 0;  ///< of a rock that rests: when it was last faster than the speeds below which rocks sleep
  Vec3d start, end;
  RockEnd ending = RockEnd::moving;
  double maxSpeed = 0, maxEnergyJ = 0, maxHeightM = 0;
  std::uint32_t impacts = 0;  ///< all of them, whatever is recorded of each

  /// Horizontal distance in a straight line, metres.
  double runoutM() const;
  /// False where the map's edge, a hole or the end of the time cut the way off: it would have gone on.
  bool hasWholeWay() const { return ending == RockEnd::resting || ending == RockEnd::broken; }
  /// Fahrboeschung: the slope of the straight line from release to end, degrees below the horizontal; 0 for a rock that
  /// has not moved.
  double energyLineDeg() const;
};

/// Whether too many ways of rocks were cut off for figures of run-outs: one in twenty moves a 95 % quantile.
inline bool areTooManyCutOff(std::uint64_t cutOff, std::uint64_t rocks) {
  constexpr std::uint64_t kOneIn = 20;
  return kOneIn * cutOff > rocks;
}

struct ImpactRecord {
  std::uint32_t rock = 0;
  std::int32_t other = -1;  ///< another rock, or -1: the ground
  MaterialId material = 0;  ///< of the other
  double timeS = 0;
  Vec3d place;  ///< a contact point, in the same frame
  double energyBeforeJ = 0, energyAfterJ = 0, impulseNS = 0;
};

struct CrossingRecord {
  std::uint32_t collector = 0, rock = 0;
  std::int32_t direction = 1;  ///< 1: from the line's left to its right, seen from its first end to its second
  double timeS = 0, alongM = 0, heightM = 0, speed = 0, energyJ = 0;
};

/// The greatest values of one rock in one cell of the raster, or at one distance from its release.
struct VisitRecord {
  std::uint32_t rock = 0;
  /// Cell [column, column + 1) times the cell's size, from the map's origin; rows count along y.
  std::int32_t column = 0, row = 0;
  double maxEnergyJ = 0, maxTranslationJ = 0, maxRotationJ = 0, maxSpeed = 0, maxHeightM = 0;
};

struct TrajectorySample {
  double timeS = 0;
  Vec3d place;
  double speed = 0, energyJ = 0, heightM = 0;
};

/// The result of a run: a pure function of (scene, run), unless its budget is in microseconds.
struct RunResult {
  std::uint64_t run = 0;
  std::vector<RockRecord> rocks;
  std::vector<ImpactRecord> impacts;
  std::vector<CrossingRecord> crossings;
  std::vector<VisitRecord> cells;                           ///< of the map
  std::vector<VisitRecord> distances;                       ///< `column` counts cells of distance, `row` is 0
  std::vector<std::vector<TrajectorySample>> trajectories;  ///< by rock
  std::vector<EffectRecord> effects;                        ///< in the order of the case's list
  std::uint64_t steps = 0, operations = 0, maxOperations = 0;
  /// Energy of all rocks at their release, and the most by which that of one rock rose above an earlier value, see
  /// `EnergyWatch`. It is potential energy (from the ground's lowest point) plus kinetic energy.
  double releasedEnergyJ = 0, energyRiseJ = 0;
  /// The rock that was released and that this one is, or is a piece of.
  std::uint32_t wholeRock(std::uint32_t rock) const;

  std::string stateHash;  ///< over all poses and velocities, once a simulated second
};

/// The cost of a run. It is not reproducible and serves only for reports.
struct RunCost {
  double cpuS = 0;
  double narrowPhaseP999Us = 0, narrowPhaseMaxUs = 0;
  std::vector<EffectReport> effects;
};

}  // namespace cairn::rockfall
