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

/// The trees to try, and the scene for the trial.
struct Trial {
  std::vector<builder::Method> methods{builder::Method::combined, builder::Method::merge, builder::Method::expand,
                                       builder::Method::octree, builder::Method::grid};
  std::vector<std::uint32_t> branchings{8, 4};  ///< only 8 for methods that cut cubes in eight
  std::vector<std::uint32_t> depths{1, 2, 3, 4};
  std::uint32_t bodies = 20;   ///< at least 2
  std::uint32_t frames = 240;  ///< recorded, 1/60 s each
  std::uint32_t starts = 3;    ///< number of random starts, each recorded separately
  std::uint32_t repeats = 1;   ///< plays after the first; all their steps count
  std::uint64_t seed = 1;
  /// Microseconds per step. Trees that are clearly worse at this budget are played less often. Nothing: all trees are
  /// played equally often.
  std::optional<double> sieveUs{};
};

struct Measured {
  std::vector<Candidate> candidates;  ///< in the order of methods, branchings, depths
  std::uint32_t busyFrames = 0;       ///< frames in which any of the trees has contacts; all figures refer to these
  std::string recording;              ///< hash of the poses
};

/// Builds every tree and records bodies of the mesh that fly to one point and bounce as exact meshes (scene converge).
/// Then plays the poses for each tree in a Bullet world, budget by budget, and repeats this for stable times. Errors
/// and operations depend only on mesh and trial, and every tree is played with every budget. With a sieve, the number
/// of plays depends on times. Fails as `buildTree` and the recording do, when no bodies touch, and with
/// `builder::kCancelled`.
Result<Measured> measure(const builder::TriangleMesh& mesh, const Trial& trial,
                         const builder::ProgressCallback& progress = {});

}  // namespace cairn::advise
