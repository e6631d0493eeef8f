// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/builder/evaluate.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::tool {

/// A tree whose leaves are this near to the mesh, as a fraction of its diagonal, is called fine.
inline constexpr double kFineLeafError = 0.025;

/// What a tree's leaves err by, and what would make it better.
struct Judgement {
  double leafErrorFraction = 0;  ///< certified, of the deepest level
  std::string words;             ///< one sentence, with an option to try where the error is large
  /// Levels to try, what they should err by as the levels there are go on, and how many spheres they would have.
  std::optional<std::uint32_t> tryDepth;
  double expectedErrorFraction = 0, expectedSpheres = 0;
};

/// Precondition: at least one level.
Judgement judge(const BuildInfo& info, const std::vector<builder::LevelFit>& fits);

}  // namespace cairn::tool
