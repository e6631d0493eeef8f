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

/// Where a program gets its sphere-tree from: a `.cairn` file, else a mesh file built in the process, else a generated
/// rock.
struct TreeSource {
  std::optional<std::filesystem::path> tree;
  std::optional<std::filesystem::path> mesh;
  RockOptions rock;
  builder::BuildOptions build;
};

struct SourcedTree {
  std::shared_ptr<const SphereTree> tree;
  std::string meshName;
  double buildWallSeconds = 0;  ///< 0 for a tree that was loaded
};

/// Fails as loadTree, importMesh and buildTree fail.
Result<SourcedTree> obtainTree(const TreeSource& source, const builder::ProgressCallback& progress = {});

}  // namespace cairn::scenes
