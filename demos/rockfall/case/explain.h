// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rockfall/case/case.h"

namespace cairn::rockfall {

/// What can be said of a group of rocks before anything is simulated. SI units.
struct GroupBounds {
  double smallestSieveM = 0, largestSieveM = 0;
  double smallestRadiusM = 0, largestRadiusM = 0;  ///< half the sieve size; farthest point from the centre
  double greatestMassKg = 0;
  double greatestInertiaRatio = 1;  ///< greatest principal moment by the least, over all variants
  double greatestFallM = 0;         ///< from where a rock may begin to the lowest ground
  double greatestSpeedMPerS = 0;    ///< sqrt(v0^2 + 2 g fall): nothing gains energy from anything but its fall
};

/// The same of a scene.
struct SceneBounds {
  std::vector<GroupBounds> groups;
  std::vector<MaterialId> groundMaterials;  ///< those the ground has somewhere
  /// The lowest ground within a region, or nothing where the region is not over the ground at all.
  std::function<std::optional<double>(const Polygon&)> lowestGround;
};

/// Whether a listed effect could act.
struct EffectOutlook {
  std::size_t index = 0;  ///< in the case's list
  std::string name;
  std::vector<std::uint32_t> groups;  ///< whose rocks could meet its criterion; empty: it can never act
  std::string reason;                 ///< one sentence: by which bound
  std::string advice;                 ///< what it may do that nobody means, and what to do; empty: nothing known
};

/// Of every listed effect. Bounds, not forecasts: what is said to be able to act may still not, what is said never to
/// act does not.
std::vector<EffectOutlook> explainEffects(const Case& scene, const SceneBounds& bounds);

}  // namespace cairn::rockfall
