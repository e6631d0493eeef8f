// SPDX-License-Identifier: Zlib
#include "cairn/core/tree_refit.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "refit_binding.h"
#include "refit_nodes.h"
#include "refit_thickness.h"
#include "refit_tuning.h"
#include "sphere_tree_check.h"

namespace cairn {

namespace {

Error refused(const std::string& what) {
  return Error{"a tree cannot follow its mesh: " + what};
}

bool isInRange(const Vec3& v) {
  return std::abs(v.x) <= kMaxLength && std::abs(v.y) <= kMaxLength && std::abs(v.z) <= kMaxLength;
}

double largestCoordinate(std::span<const Vec3> vertices) {
  float most = 0;
  for (const Vec3& v : vertices) most = std::max({most, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return double(most);
}

}  // namespace

struct TreeRefit::State {
  std::shared_ptr<const SphereTree> first;
  RefitBinding binding;
  std::vector<FacingPlaces> facing;
  std::vector<Vec3d> places;
  std::vector<Vec3> inTree;  // vertices given in the mesh's frame
  std::vector<ThicknessSample> samples;
  SurfaceDepthSearch search;
  std::vector<std::shared_ptr<SphereTree>> trees;  // results, some of which others hold

  Status check(std::span<const Vec3> vertices) const;
  Status checkTriangles(std::span<const Vec3> vertices) const;
  std::shared_ptr<SphereTree> spare();
  void move(SphereTree& tree, std::span<const Vec3> vertices);
  void moveRecords(SphereTree& tree) const;
};

Status TreeRefit::State::check(std::span<const Vec3> vertices) const {
  const std::size_t count = first->vertices().size();
  if (vertices.size() != count)
    return refused("it has " + std::to_string(count) + " vertices, not " + std::to_string(vertices.size()) +
                   "; give all of them, in the order of the tree's");
  for (std::size_t v = 0; v < count; ++v)
    if (!isInRange(vertices[v]))
      return refused("vertex " + std::to_string(v) + " is not finite or farther out than 1e15; keep the last shape");
  return checkTriangles(vertices);
}

Status TreeRefit::State::checkTriangles(std::span<const Vec3> vertices) const {
  double volume = 0;  // six times
  for (std::size_t t = 0; t < first->triangles().size(); ++t) {
    const auto& [i, j, k] = first->triangles()[t];
    const Vec3d a(vertices[i]), b(vertices[j]), c(vertices[k]);
    if (binding.areas[t] > 0 && !(lengthSq(cross(b - a, c - a)) > 0))
      return refused("triangle " + std::to_string(t) + " has lost its area; keep its corners apart");
    volume += dot(a, cross(b, c));
  }
  if (!(volume > 0)) return refused("its volume is not positive any more; do not turn it inside out");
  return {};
}

// The fence goes with the count's last decrease by another thread, whose reads are then over.
std::shared_ptr<SphereTree> TreeRefit::State::spare() {
  for (const std::shared_ptr<SphereTree>& tree : trees)
    if (tree.use_count() == 1) {
      std::atomic_thread_fence(std::memory_order_acquire);
      return tree;
    }
  trees.push_back(std::make_shared<SphereTree>(*first));
  trees.back()->data_.levelMeshes.clear();
  trees.back()->levelSurfaces_.clear();
  return trees.back();
}

void TreeRefit::State::move(SphereTree& tree, std::span<const Vec3> vertices) {
  std::copy(vertices.begin(), vertices.end(), tree.data_.vertices.begin());
  binding.move(tree, vertices, places);
  TreeSurface& surface = tree.surface_;
  surface.features.follow(tree.vertices(), tree.triangles());
  surface.patches.follow(tree.vertices(), tree.triangles(), surface.features);
  surface.thickness = thicknessOf(tree, facing, samples);
  moveRecords(tree);
  const MovedMesh mesh{*first, binding, places, tree.surfaceView(), refit::kRounding * largestCoordinate(vertices)};
  tree.extent_ = 0;
  for (std::uint32_t record = 0; record < tree.nodeCount(); ++record) {
    tree.data_.nodes[record] = refittedNode(mesh, record, search);
    if (!tree.data_.bounds.empty()) tree.data_.bounds[record] = refittedBound(mesh, record);
    tree.packBall(record);
  }
  for (const NodeId node : tree.nodeAt_) tree.packFlatness(node);
  tree.corners_.clear();
  tree.listCorners();
}

void TreeRefit::State::moveRecords(SphereTree& tree) const {
  for (std::size_t i = 0; i < binding.support.size(); ++i)
    if (binding.support[i] != SurfaceEdge::kNone) tree.data_.supportPoints[i] = Vec3(places[binding.support[i]]);
  for (std::size_t i = 0; i < binding.faceOfNormal.size(); ++i)
    tree.data_.faceNormals[i] = tree.surface_.features.faces()[binding.faceOfNormal[i]].normal;
}

Result<TreeRefit> TreeRefit::bind(std::shared_ptr<const SphereTree> tree) {
  if (!tree) return refused("there is no tree; load one with cairn::loadTree first");
  if (const std::uint32_t lost = firstUnlisted(*tree); lost < tree->triangles().size())
    return refused("no leaf lists triangle " + std::to_string(lost) + "; build the tree again");
  auto state = std::make_unique<State>();
  state->binding = bindTree(*tree);
  state->facing = facingPlaces(*tree);
  state->places.resize(state->binding.places.size());
  state->first = std::move(tree);
  return TreeRefit(std::move(state));
}

TreeRefit::TreeRefit(std::unique_ptr<State> state) : state_(std::move(state)) {}
TreeRefit::~TreeRefit() = default;
TreeRefit::TreeRefit(TreeRefit&&) noexcept = default;
TreeRefit& TreeRefit::operator=(TreeRefit&&) noexcept = default;

Result<std::shared_ptr<const SphereTree>> TreeRefit::refit(std::span<const Vec3> vertices) {
  if (Status status = state_->check(vertices); !status) return status.error();
  const std::shared_ptr<SphereTree> tree = state_->spare();
  state_->move(*tree, vertices);
  return std::shared_ptr<const SphereTree>(tree);
}

Result<std::shared_ptr<const SphereTree>> TreeRefit::refitMesh(std::span<const Vec3> vertices) {
  const Vec3d origin = state_->first->origin();
  state_->inTree.clear();
  for (const Vec3& v : vertices) state_->inTree.push_back(Vec3(Vec3d(v) - origin));
  return refit(state_->inTree);
}

}  // namespace cairn
