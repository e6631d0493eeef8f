// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/command/tree_source.h"

#include <chrono>
#include <utility>

#include "cairn/builder/import.h"
#include "cairn/core/tree_file.h"

namespace cairn::scenes {

Result<SourcedTree> obtainTree(const TreeSource& source, const builder::ProgressCallback& progress) {
  if (source.tree) {
    auto tree = loadTree(*source.tree);
    if (!tree) return tree.error();
    auto shared = std::make_shared<const SphereTree>(std::move(tree).value());
    return SourcedTree{shared, shared->info().meshName, 0};
  }
  auto mesh = source.mesh ? builder::importMesh(*source.mesh) : Result(generateRock(source.rock));
  if (!mesh) return mesh.error();
  const auto start = std::chrono::steady_clock::now();
  auto tree = builder::buildTree(mesh.value(), source.build, progress);
  if (!tree) return tree.error();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return SourcedTree{std::make_shared<const SphereTree>(std::move(tree).value()), mesh.value().name, elapsed.count()};
}

}  // namespace cairn::scenes
