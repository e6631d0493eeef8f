// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cairn/builder/build.h"
#include "cairn/builder/evaluate.h"

namespace cairn::accuracy_cost {

/// Builds a tree and proves it. Fails as `buildTree` does, when the proof fails, and with `kCancelled`.
Result<SphereTree> provenTree(const builder::TriangleMesh& mesh, const builder::BuildOptions& options,
                              const builder::ProgressCallback& progress);

/// Builds a tree, proves it and measures each level's fit, sampled with the build's own seed. Fails as `buildTree`
/// does, when the proof fails, and with `kCancelled`.
Result<std::vector<builder::LevelFit>> treeFit(const builder::TriangleMesh& mesh, const builder::BuildOptions& options,
                                               const builder::ProgressCallback& progress);

}  // namespace cairn::accuracy_cost
