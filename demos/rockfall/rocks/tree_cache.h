// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cairn/builder/build.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::rockfall {

/// A cache of trees as files. A file's name is the SHA-256 of the tree's origin: mesh, options and version of the file
/// format. Any number of processes may share a folder. Files appear completely or not at all, and two processes that
/// build the same tree write the same bytes.
///
///     TreeCache cache(TreeCache::defaultFolder());
///     auto tree = cache.obtain(mesh, options);
class TreeCache {
 public:
  /// Without a folder no tree is stored.
  explicit TreeCache(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

  /// Loads the tree, verified like any tree file, or builds it. A broken file is rebuilt and replaced. A tree that
  /// cannot be stored is no failure: see `complaint`. Fails as `buildTree` does. Precondition: `options` has no
  /// balance.
  Result<std::shared_ptr<const SphereTree>> obtain(const builder::TriangleMesh& mesh,
                                                   const builder::BuildOptions& options,
                                                   const builder::ProgressCallback& progress = {});

  /// Numbers of trees built and loaded.
  std::uint32_t built() const { return built_; }
  std::uint32_t loaded() const { return loaded_; }
  /// The reason why the last unstored tree could not be stored.
  const std::optional<Error>& complaint() const { return complaint_; }

  /// `$XDG_CACHE_HOME/cairn`, else `~/.cache/cairn`, else nothing.
  static std::optional<std::filesystem::path> defaultFolder();

  /// Returns the name of the file for such a tree.
  static std::string fileName(const builder::TriangleMesh& mesh, const builder::BuildOptions& options);

 private:
  std::optional<std::filesystem::path> folder_;
  std::uint32_t built_ = 0, loaded_ = 0;
  std::optional<Error> complaint_;
};

}  // namespace cairn::rockfall
