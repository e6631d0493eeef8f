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

/// Trees kept as files named by the SHA-256 of what they were built from: mesh, options, version of the file format.
/// Any number of processes may share a folder: files appear complete or not at all, and two that build the same tree
/// write the same bytes.
class TreeCache {
 public:
  /// Without a folder nothing is kept.
  explicit TreeCache(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

  /// Loads the tree, verified as any tree file is, or builds it; a broken file is built anew and replaced. That it
  /// cannot be kept is no failure: see `complaint`. Fails as `buildTree` does.
  /// Precondition: no balance.
  Result<std::shared_ptr<const SphereTree>> obtain(const builder::TriangleMesh& mesh,
                                                   const builder::BuildOptions& options,
                                                   const builder::ProgressCallback& progress = {});

  /// How many trees were built and loaded.
  std::uint32_t built() const { return built_; }
  std::uint32_t loaded() const { return loaded_; }
  /// Why the last tree that could not be kept was not.
  const std::optional<Error>& complaint() const { return complaint_; }

  /// `$XDG_CACHE_HOME/cairn`, else `~/.cache/cairn`, else nothing.
  static std::optional<std::filesystem::path> defaultFolder();

  /// Name of the file that holds such a tree.
  static std::string fileName(const builder::TriangleMesh& mesh, const builder::BuildOptions& options);

 private:
  std::optional<std::filesystem::path> folder_;
  std::uint32_t built_ = 0, loaded_ = 0;
  std::optional<Error> complaint_;
};

}  // namespace cairn::rockfall
