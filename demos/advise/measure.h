// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "advise/advice.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::advise {

/// What is tried, and on what.
struct Trial {
  std::vector<builder::Method> methods{builder::Method::combined, builder::Method::merge, builder::Method::expand,
                                       builder::Method::octree, builder::Method::grid};
  std::vector<std::uint32_t> branchings{8, 4};  ///< 8 alone for methods that cut cubes in eight
  std::vector<std::uint32_t> depths{1, 2, 3, 4};
  std::uint32_t bodies = 20;   ///< at least 2
  std::uint32_t frames = 240;  ///< recorded, 1/60 s each
  std::uint32_t starts = 3;    ///< random ones, each recorded for itself
  std::uint32_t repeats = 1;   ///< playings after the first; all their steps count
  std::uint64_t seed = 1;
  /// Microseconds a step: trees that are clearly behind at this budget are played less often. Nothing: all alike.
  std::optional<double> sieveUs{};
};

struct Measured {
  std::vector<Candidate> candidates;  ///< in the order of methods, branchings, depths
  std::uint32_t busyFrames = 0;       ///< in which any of the trees has contacts: what all figures are of
  std::string recording;              ///< hash of the poses
};

/// Builds every tree, records bodies of the mesh that fly to one point and bounce as exact meshes (scene converge), and
/// shows the poses to each tree in a Bullet world, budget by budget, again and again for its times. Errors and
/// operations depend on mesh and trial alone, and every tree is played on every budget; with a sieve the number of its
/// playings depends on times. Fails as `buildTree` and the recording do, when no bodies touch, and with
/// `builder::kCancelled`.
Result<Measured> measure(const builder::TriangleMesh& mesh, const Trial& trial,
                         const builder::ProgressCallback& progress = {});

}  // namespace cairn::advise
