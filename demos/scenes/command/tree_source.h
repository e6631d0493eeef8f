// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cairn/builder/build.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"
#include "scenes/bodies/rock.h"

namespace cairn::scenes {

/// The source of a program's sphere-tree: a `.cairn` file, else a mesh file from which a tree is built, else a
/// generated rock.
struct TreeSource {
  std::optional<std::filesystem::path> tree;
  std::optional<std::filesystem::path> mesh;
  RockOptions rock;
  builder::BuildOptions build;
};

struct SourcedTree {
  std::shared_ptr<const SphereTree> tree;
  std::string meshName;
  double buildWallSeconds = 0;  ///< 0 for a loaded tree
};

/// Loads or builds the tree. Fails as `loadTree`, `importMesh` and `buildTree` do.
Result<SourcedTree> obtainTree(const TreeSource& source, const builder::ProgressCallback& progress = {});

}  // namespace cairn::scenes
