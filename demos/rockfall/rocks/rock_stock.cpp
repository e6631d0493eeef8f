// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/rocks/rock_stock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "cairn/builder/fracture.h"
#include "cairn/builder/import.h"
#include "cairn/core/tree_file.h"
#include "rockfall/case/content_hash.h"
#include "rockfall/rocks/rock_maker.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {
namespace {

constexpr std::uint64_t kShapeFamily = 0x726F636B73;  // separate from the seeds of runs

Result<std::vector<builder::TriangleMesh>> meshesOf(const Case& scene, std::size_t group) {
  std::vector<builder::TriangleMesh> meshes;
  const auto& source = scene.rocks[group].source;
  if (const auto* file = std::get_if<MeshRocks>(&source)) {
    auto mesh = builder::importMesh(scene.pathOf(file->file));
    if (!mesh) return mesh.error();
    meshes.push_back(std::move(mesh).value());
    return meshes;
  }
  const auto& made = std::get<MadeRocks>(source);
  scenes::Random seeds(mixBits(scene.seed + kShapeFamily), group);
  for (std::uint32_t i = 0; i < made.variants; ++i) meshes.push_back(makeRock(made.kind, made.concave, seeds.bits()));
  return meshes;
}

// The pieces' trees are as deep as the whole's.
Result<std::shared_ptr<const effects::Fragments>> fragmentsOf(const builder::TriangleMesh& mesh, const SphereTree& tree,
                                                              TreeCache& cache, const builder::BuildOptions& options,
                                                              const builder::ProgressCallback& progress) {
  auto fracture = builder::fracture(mesh, tree, progress);
  if (!fracture) return fracture.error();
  auto fragments = std::make_shared<effects::Fragments>();
  for (const builder::TriangleMesh& piece : fracture.value().pieces) {
    auto pieceTree = cache.obtain(piece, options, progress);
    if (!pieceTree) return pieceTree.error();
    fragments->pieces.push_back(std::move(pieceTree).value());
  }
  for (const builder::Bond& bond : fracture.value().bonds) fragments->bonds.push_back({bond.first, bond.second});
  return std::shared_ptr<const effects::Fragments>(std::move(fragments));
}

}  // namespace

RockShape measureRock(std::shared_ptr<const SphereTree> tree) {
  const MassProperties& mass = tree->mass();
  RockShape shape;
  Vec3d lower(1e300, 1e300, 1e300), upper = -lower;
  for (const Vec3& vertex : tree->vertices()) {
    const Vec3d p = transpose(mass.principalAxes) * (Vec3d(vertex) + tree->origin() - mass.centerOfMass);
    shape.reach = std::max(shape.reach, length(p));
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], p[axis]);
      upper[axis] = std::max(upper[axis], p[axis]);
    }
  }
  std::array<double, 3> extents{upper.x - lower.x, upper.y - lower.y, upper.z - lower.z};
  std::ranges::sort(extents);
  shape.scale = 1 / extents[1];
  std::ranges::transform(extents, shape.extents.begin(), [&](double extent) { return extent * shape.scale; });
  shape.reach *= shape.scale;
  shape.volume = mass.volume * shape.scale * shape.scale * shape.scale;
  shape.inertiaRatio = mass.principalMoments.z / mass.principalMoments.x;
  shape.tree = std::move(tree);
  return shape;
}

Result<RockStock> stockRocks(const Case& scene, TreeCache& cache, const builder::ProgressCallback& progress) {
  RockStock stock;
  ContentHash hash;
  for (std::size_t group = 0; group < scene.rocks.size(); ++group) {
    const auto inGroup = [&](const Error& error) { return Error{fmt::format("/rocks/{}: {}", group, error.message)}; };
    const auto meshes = meshesOf(scene, group);
    if (!meshes) return meshes.error();
    builder::BuildOptions options;
    options.depth = scene.rocks[group].treeDepth;
    std::vector<RockShape>& shapes = stock.groups.emplace_back();
    for (const builder::TriangleMesh& mesh : meshes.value()) {
      auto tree = cache.obtain(mesh, options, progress);
      if (!tree) return tree.error();
      hash.add(encodeTree(*tree.value()));
      shapes.push_back(measureRock(std::move(tree).value()));
      if (findEffect<FragmentationOptions>(scene.effects) == nullptr) continue;
      auto fragments = fragmentsOf(mesh, *shapes.back().tree, cache, options, progress);
      if (!fragments) return inGroup(fragments.error());
      shapes.back().fragments = std::move(fragments).value();
    }
  }
  stock.hash = hash.hex();
  return stock;
}

}  // namespace cairn::rockfall
