// SPDX-License-Identifier: Zlib
#include "cairn/core/sphere_tree.h"

#include <algorithm>
#include <utility>

#include "sphere_tree_check.h"

namespace cairn {

namespace {

constexpr std::uint32_t kNoRecord = 0xFFFFFFFFU;
constexpr float kSameFaceCosine = 0.99862953F;    // 3 degrees
constexpr float kPlanarCosine = 0.996194698F;     // 5 degrees
constexpr float kSharpEdgeCosine = 0.866025404F;  // 30 degrees

SupportBlock packSupport(std::span<const Vec3> points) {
  SupportBlock block;
  for (std::uint32_t lane = 0; lane < SupportBlock::kWidth; ++lane) {
    const Vec3& p = points[std::min<std::size_t>(lane, points.size() - 1)];
    block.x[lane] = p.x;
    block.y[lane] = p.y;
    block.z[lane] = p.z;
  }
  return block;
}

TreeSurface surfaceOf(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles) {
  TreeSurface surface;
  surface.features = SurfaceFeatures(vertices, triangles);
  surface.patches = SurfacePatches(vertices, triangles, surface.features);
  surface.thickness = surfaceThickness({vertices, triangles, &surface});
  return surface;
}

template <class T>
std::size_t bytesOf(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

}  // namespace

Result<SphereTree> SphereTree::create(SphereTreeData data) {
  if (Status status = checkTree(data); !status) return status.error();
  return SphereTree(std::move(data));
}

SphereTree::SphereTree(SphereTreeData data) : data_(std::move(data)) {
  // Asked for the first time, a processor takes tens of microseconds to say what it can do: not in somebody's first
  // step.
  static_cast<void>(simdTargetName());
  linkFamilies();
  const std::size_t slots = families_.size() * kFamilyWidth;
  traversalNodes_.resize(slots);
  if (!data_.bounds.empty()) answeringNodes_.resize(slots);
  support_.resize(slots);
  recordIndex_.resize(slots, kNoRecord);
  level_.resize(slots, 0);
  for (std::uint32_t record = 0; record < nodeCount(); ++record) packNode(record);
  for (const NodeId id : nodeAt_) packChildLanes(id);
  flatness_.resize(slots, 0);
  for (const NodeId id : nodeAt_) packFlatness(id);
  listCorners();
  surface_ = surfaceOf(data_.vertices, data_.triangles);
  for (const LevelMesh& mesh : data_.levelMeshes) levelSurfaces_.push_back(surfaceOf(mesh.vertices, mesh.triangles));
}

// A triangle without area faces nowhere and contradicts nothing.
bool SphereTree::facesOnly(NodeId leaf) const {
  const std::span<const Vec3> normals = faceNormals(leaf);
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = i + 1; j < normals.size(); ++j)
      if (dot(normals[i], normals[j]) > kSharpEdgeCosine) return false;
  return !normals.empty() && std::ranges::all_of(regionTriangles(leaf), [&](std::uint32_t triangle) {
    const auto& [a, b, c] = data_.triangles[triangle];
    const Vec3 out = cross(data_.vertices[b] - data_.vertices[a], data_.vertices[c] - data_.vertices[a]);
    const float least = kSameFaceCosine * length(out);
    return std::ranges::any_of(normals, [&](const Vec3& n) { return dot(n, out) >= least; });
  });
}

// Names every node: the children of the k-th inner node, breadth-first, are family k + 1.
void SphereTree::linkFamilies() {
  nodeAt_.assign(nodeCount(), kRootNode);
  families_.emplace_back();
  familySize_.push_back(1);
  for (std::uint32_t record = 1; record < nodeCount(); ++record) {
    if (record == 1 || data_.nodes[record].parent != data_.nodes[record - 1].parent) {
      families_.emplace_back();
      familySize_.push_back(0);
    }
    const auto family = static_cast<std::uint32_t>(families_.size() - 1);
    nodeAt_[record] = family * kFamilyWidth + familySize_.back()++;
  }
}

void SphereTree::packNode(std::uint32_t record) {
  const NodeData& n = data_.nodes[record];
  const NodeId id = nodeAt_[record];
  recordIndex_[id] = record;
  packBall(record);
  ++leafCount_;
  if (record == 0) return;
  const NodeId parent = nodeAt_[n.parent];
  leafCount_ -= isLeaf(parent);  // counted as a leaf until its first child came
  traversalNodes_[parent].childFamily = id / kFamilyWidth;
  level_[id] = static_cast<std::uint8_t>(level_[parent] + 1);
  depth_ = std::max<std::uint32_t>(depth_, level_[id]);
}

void SphereTree::packBall(std::uint32_t record) {
  const NodeData& n = data_.nodes[record];
  const NodeId id = nodeAt_[record];
  const Sphere bound = data_.bounds.empty() ? Sphere{n.center, n.radius} : data_.bounds[record];
  families_[id / kFamilyWidth].set(id % kFamilyWidth, bound);
  TraversalNode& node = traversalNodes_[id];
  node = {bound.center, bound.radius, node.childFamily, n.error, node.childLanes, n.innerRadius};
  if (!answeringNodes_.empty()) answeringNodes_[id] = {.center = n.center, .radius = n.radius};
  support_[id] = packSupport(supportPoints(id));
  extent_ = std::max({extent_, length(n.center) + n.radius, length(bound.center) + bound.radius});
}

void SphereTree::packFlatness(NodeId id) {
  flatness_[id] = 0;
  if (isLeaf(id) && facesOnly(id)) flatness_[id] |= kFaceted;
  if (node(id).normalCone.cosine >= kPlanarCosine) flatness_[id] |= kPlanar;
}

void SphereTree::packChildLanes(NodeId id) {
  if (isLeaf(id)) return;
  TraversalNode& node = traversalNodes_[id];
  const std::uint32_t size = familySize(node.childFamily);
  node.childLanes = livingLanes(node.childFamily) | size << TraversalNode::kCountShift;
  for (std::uint32_t lane = 0; lane < size; ++lane)
    if (isLeaf(node.childFamily * kFamilyWidth + lane)) node.childLanes |= 1U << (TraversalNode::kLeafShift + lane);
}

std::span<const Vec3> SphereTree::supportPoints(NodeId id) const {
  const NodeData& n = node(id);
  return std::span(data_.supportPoints).subspan(n.firstSupport, n.supportCount);
}

std::span<const Vec3> SphereTree::faceNormals(NodeId id) const {
  const NodeData& n = node(id);
  return std::span(data_.faceNormals).subspan(n.firstNormal, n.normalCount);
}

std::span<const std::uint32_t> SphereTree::regionTriangles(NodeId id) const {
  const NodeData& n = node(id);
  return std::span(data_.regionTriangles).subspan(n.firstTriangle, n.triangleCount);
}

std::vector<NodeId> SphereTree::levelCut(std::uint32_t level) const {
  std::vector<NodeId> cut;
  for (const NodeId id : nodeAt_)
    if (level_[id] == level || (level_[id] < level && isLeaf(id))) cut.push_back(id);
  return cut;
}

float SphereTree::levelError(std::uint32_t level) const {
  float worst = 0;
  for (const NodeId id : levelCut(level)) worst = std::max(worst, error(id));
  return worst;
}

std::size_t SphereTree::memoryBytes() const {
  std::size_t ofLevels = bytesOf(data_.levelMeshes) + bytesOf(levelSurfaces_);
  for (std::uint32_t level = 1; level <= levelMeshCount(); ++level)
    ofLevels += bytesOf(levelMesh(level).vertices) + bytesOf(levelMesh(level).triangles) +
                levelSurfaces_[level - 1].features.memoryBytes() + levelSurfaces_[level - 1].patches.memoryBytes();
  return ofLevels + sizeof(*this) + bytesOf(data_.nodes) + bytesOf(data_.supportPoints) + bytesOf(data_.faceNormals) +
         bytesOf(data_.regionTriangles) + bytesOf(data_.vertices) + bytesOf(data_.triangles) + bytesOf(families_) +
         bytesOf(flatness_) + bytesOf(traversalNodes_) + bytesOf(answeringNodes_) + bytesOf(data_.bounds) +
         bytesOf(support_) + bytesOf(recordIndex_) + bytesOf(level_) + bytesOf(corners_) + bytesOf(firstCorner_) +
         bytesOf(familySize_) + bytesOf(nodeAt_) + surface_.features.memoryBytes() + surface_.patches.memoryBytes();
}

}  // namespace cairn
