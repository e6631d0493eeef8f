// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/scene_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cairn::rockfall {
namespace {

/// Of the smallest rock's radius, passed in a step at the greatest speed there can be: real speeds are half of it, and
/// half a radius a step is where docs/rockfall.md still finds none of the answer in the step.
constexpr double kMaxRadii = 1;
/// Of the ground's cell: what is passed over in a step has not been touched.
constexpr double kMaxCells = 1;

/// The group whose rocks pass most of their own radius in a step.
struct Fastest {
  std::size_t group = 0;
  double travelM = 0, radiusM = 1;  ///< in a step; of its smallest rock

  double radii() const { return travelM / radiusM; }
};

Fastest fastestOf(const Case& scene, const SceneBounds& bounds) {
  Fastest fastest;
  for (std::size_t g = 0; g < bounds.groups.size(); ++g) {
    const GroupBounds& group = bounds.groups[g];
    const Fastest own{g, group.greatestSpeedMPerS * scene.stepS, group.smallestRadiusM};
    if (own.radii() > fastest.radii()) fastest = own;
  }
  return fastest;
}

// With one digit, not longer.
double roundedDown(double step) {
  const double digit = std::pow(10, std::floor(std::log10(step)));
  return std::floor(step / digit) * digit;
}

std::string passes(const Fastest& fastest) {
  return fmt::format("a rock of group {} may pass {:.2g} m in a step", fastest.group, fastest.travelM);
}

void warnOfStep(const Case& scene, const SceneBounds& bounds, const Fastest& fastest,
                std::vector<SceneWarning>& warnings) {
  const double byRadius = kMaxRadii * fastest.radiusM, byCell = kMaxCells * bounds.groundCellM;
  if (fastest.travelM <= std::min(byRadius, byCell)) return;
  const bool isByRadius = byRadius <= byCell;
  const double step = roundedDown(scene.stepS * std::min(byRadius, byCell) / fastest.travelM);
  warnings.push_back(
      {"/step_s",
       fmt::format("{}, more than {} of {:.2g} m: try {:g} s, or ask \"rockfall converge\" which step is fine "
                   "enough",
                   passes(fastest), isByRadius ? "the smallest one's radius" : "a cell of the ground",
                   isByRadius ? fastest.radiusM : bounds.groundCellM, step)});
}

void warnOfMissing(const Case& scene, const Fastest& fastest, std::vector<SceneWarning>& warnings) {
  if (findEffect<FrictionOptions>(scene.effects) == nullptr &&
      findEffect<SlipFrictionOptions>(scene.effects) == nullptr)
    warnings.push_back({"/effects", "no \"friction\" is listed: all ground is smoother than ice, and nothing rolls"});
  if (findEffect<RestitutionOptions>(scene.effects) == nullptr)
    warnings.push_back({"/effects", "no \"restitution\" is listed: no rock bounces"});
  if (findEffect<CcdOptions>(scene.effects) == nullptr && fastest.radii() > CcdOptions().radiiPerStep)
    warnings.push_back(
        {"/effects", fmt::format("no \"ccd\" is listed: {}, {:.2g} of its radius, and what is thin may be "
                                 "passed through",
                                 passes(fastest), fastest.radii())});
}

}  // namespace

std::vector<SceneWarning> sceneWarnings(const Case& scene, const SceneBounds& bounds) {
  const Fastest fastest = fastestOf(scene, bounds);
  std::vector<SceneWarning> warnings;
  warnOfStep(scene, bounds, fastest, warnings);
  warnOfMissing(scene, fastest, warnings);
  return warnings;
}

}  // namespace cairn::rockfall
