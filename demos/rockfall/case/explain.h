// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rockfall/case/case.h"

namespace cairn::rockfall {

/// Bounds for a group of rocks before any simulation. SI units.
struct GroupBounds {
  double smallestSieveM = 0, largestSieveM = 0;
  double smallestRadiusM = 0, largestRadiusM = 0;  ///< half the sieve size; farthest point from the centre
  double greatestMassKg = 0;
  double greatestInertiaRatio = 1;  ///< greatest principal moment by the least, over all variants
  double greatestFallM = 0;         ///< from where a rock may begin to the lowest ground
  double greatestSpeedMPerS = 0;    ///< sqrt(v0^2 + 2 g fall), of a rock that no other strikes
  double struckSpeedMPerS = 0;      ///< of a rock of the least mass that got the energy of all it may meet
};

/// Bounds for a scene before any simulation.
struct SceneBounds {
  std::vector<GroupBounds> groups;
  double groundCellM = 0;                   ///< between the points of its grid
  std::vector<MaterialId> groundMaterials;  ///< those the ground has somewhere
  /// Returns the lowest ground within a region; nothing for a region without ground.
  std::function<std::optional<double>(const Polygon&)> lowestGround;
};

/// The possible action of a listed effect.
struct EffectOutlook {
  std::size_t index = 0;  ///< in the case's list
  std::string name;
  std::vector<std::uint32_t> groups;  ///< groups whose rocks could meet its criterion; empty: it can never act
  std::string reason;                 ///< one sentence that names the bound
  std::string advice;                 ///< an unintended consequence and its remedy; empty: none known
};

/// Returns the outlook of every listed effect. Outlooks are bounds, not forecasts: an effect that may act need not act,
/// but an effect that can never act does not.
std::vector<EffectOutlook> explainEffects(const Case& scene, const SceneBounds& bounds);

/// Which published class of soil a pair of materials has, and what it stands for.
struct SoilNote {
  std::string path, text;
};
std::vector<SoilNote> explainSoils(const Case& scene);

}  // namespace cairn::rockfall
