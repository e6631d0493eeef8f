// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/rocks/tree_cache.h"

#include <fmt/format.h>

#include <cassert>
#include <cstdlib>
#include <span>
#include <system_error>
#include <utility>

#include "cairn/core/tree_file.h"
#include "rockfall/case/content_hash.h"

namespace cairn::rockfall {
namespace {

namespace fs = std::filesystem;

Status keep(const SphereTree& tree, const fs::path& file) {
  std::error_code failure;
  fs::create_directories(file.parent_path(), failure);
  if (failure)
    return Error{fmt::format("cannot make the folder {}: {}", file.parent_path().string(), failure.message())};
  return saveTree(tree, file);
}

std::optional<fs::path> folderNamed(const char* variable) {
  const char* value = std::getenv(variable);
  if (!value || !*value) return {};
  return fs::path(value);
}

/// All options that the tree depends on; the number of threads is not among them.
std::string describe(const builder::BuildOptions& options) {
  assert(!options.balance);
  std::string text =
      fmt::format("format {} method {} branching {} depth {} samples {} seed {}", kTreeFileVersion,
                  builder::methodName(options.method), options.branching, options.depth, options.samples, options.seed);
  if (options.optimiser) text += fmt::format(" optimiser {}", builder::optimiserName(*options.optimiser));
  return text;
}

}  // namespace

Result<std::shared_ptr<const SphereTree>> TreeCache::obtain(const builder::TriangleMesh& mesh,
                                                            const builder::BuildOptions& options,
                                                            const builder::ProgressCallback& progress) {
  std::optional<fs::path> file;
  if (folder_) file = *folder_ / fileName(mesh, options);
  if (file && fs::exists(*file))
    if (auto tree = loadTree(*file)) {
      ++loaded_;
      return std::make_shared<const SphereTree>(std::move(tree).value());
    }
  auto tree = builder::buildTree(mesh, options, progress);
  if (!tree) return tree.error();
  ++built_;
  if (file)
    if (const Status kept = keep(tree.value(), *file); !kept) complaint_ = kept.error();
  return std::make_shared<const SphereTree>(std::move(tree).value());
}

std::optional<fs::path> TreeCache::defaultFolder() {
  if (const auto cache = folderNamed("XDG_CACHE_HOME")) return *cache / "cairn";
  if (const auto home = folderNamed("HOME")) return *home / ".cache" / "cairn";
  return {};
}

std::string TreeCache::fileName(const builder::TriangleMesh& mesh, const builder::BuildOptions& options) {
  ContentHash hash;
  hash.add(describe(options));
  hash.add(mesh.name);
  hash.add(mesh.sha256);
  hash.add(std::as_bytes(std::span(mesh.vertices)));
  hash.add(std::as_bytes(std::span(mesh.triangles)));
  return hash.hex() + ".cairn";
}

}  // namespace cairn::rockfall
