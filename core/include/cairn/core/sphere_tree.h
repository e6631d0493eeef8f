// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/family.h"
#include "cairn/core/mass_properties.h"
#include "cairn/core/result.h"
#include "cairn/core/tree_surface.h"
#include "cairn/core/vec3.h"

namespace cairn {

/// Names a node: eight times its family plus its lane. The root is node 0; dead lanes have no name.
using NodeId = std::uint32_t;

/// The node that holds the whole surface.
inline constexpr NodeId kRootNode = 0;
/// Extreme points listed for a node at most.
inline constexpr std::uint32_t kMaxSupportPoints = 16;
/// Face directions listed for a node at most.
inline constexpr std::uint32_t kMaxFaceNormals = 3;
/// Of a region that has more, corners are not listed: see `SphereTree::regionCorners`.
inline constexpr std::uint32_t kMaxRegionCorners = 256;
/// Levels below the root at most.
inline constexpr std::uint32_t kMaxDepth = 15;

/// Directions within `halfAngle` of `axis`; holds every source normal of a region. `cosine` = cos(halfAngle),
/// -1 when the region faces everywhere.
struct NormalCone {
  Vec3 axis{0, 0, 1};  ///< unit, tree frame
  float cosine = -1;   ///< of the half-angle

  friend bool operator==(const NormalCone&, const NormalCone&) = default;
};

/// One node as a builder or a file describes it. All lengths in mesh units; all positions in the *tree frame*: mesh
/// axes, origin at `SphereTreeData::origin`.
struct NodeData {
  Vec3 center;               ///< of the node's ball: the one that answers, where the node has two
  float radius = 0;          ///< the closed ball holds the node's region of the surface
  float error = 0;           ///< certified protrusion: no point of the ball is farther from the solid
  float innerRadius = 0;     ///< the concentric ball of this radius lies inside the solid; 0 when the centre does not
  std::uint32_t parent = 0;  ///< breadth-first number of the parent; 0 for the root
  std::uint32_t firstSupport = 0, supportCount = 0;    ///< into supportPoints, 1..kMaxSupportPoints
  std::uint32_t firstNormal = 0, normalCount = 0;      ///< into faceNormals, 0..kMaxFaceNormals
  std::uint32_t firstTriangle = 0, triangleCount = 0;  ///< into regionTriangles; a child's range lies in its parent's
  NormalCone normalCone;                               ///< of the source normals of the region

  friend bool operator==(const NodeData&, const NodeData&) = default;
};

/// The data that a traversal reads of a node to split or move it: half a cache line.
struct alignas(32) TraversalNode {
  Vec3 center;                    ///< of the node's bound, tree frame
  float radius = 0;               ///< of the node's bound
  std::uint32_t childFamily = 0;  ///< 0 for a leaf (family 0 is the root's own)
  float error = 0;                ///< as `NodeData::error`
  std::uint32_t childLanes = 0;   ///< of the child family, packed: see the functions below
  float innerRadius = 0;          ///< as `NodeData::innerRadius`

  static constexpr std::uint32_t kLaneMask = 0xFF, kLeafShift = 8, kCountShift = 16;  ///< how `childLanes` is packed
  /// One bit per child.
  static constexpr std::uint32_t living(std::uint32_t childLanes) { return childLanes & kLaneMask; }
  /// One bit per child that is a leaf.
  static constexpr std::uint32_t leaves(std::uint32_t childLanes) { return childLanes >> kLeafShift & kLaneMask; }
  /// How many children there are.
  static constexpr std::uint32_t count(std::uint32_t childLanes) { return childLanes >> kCountShift; }
};
static_assert(sizeof(TraversalNode) == 32 && std::is_trivially_copyable_v<TraversalNode>);

/// How a tree came to be, for reports; nothing at run time depends on it.
struct BuildInfo {
  std::string meshName;                                 ///< file name without folder
  std::string meshSha256;                               ///< of the mesh file's bytes, hexadecimal
  std::string method;                                   ///< name of the method, as `cairn build --method` takes it
  std::uint32_t branching = 0, depth = 0, samples = 0;  ///< as given to the builder
  std::uint64_t seed = 0;                               ///< as given to the builder

  friend bool operator==(const BuildInfo&, const BuildInfo&) = default;
};

/// A closed mesh that stands for the source at one level of the tree, with fewer triangles.
struct LevelMesh {
  std::vector<Vec3> vertices;                           ///< tree frame
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`, counter-clockwise from outside
  float distance = 0;  ///< certified, mesh units: no point of either surface is farther from the other

  friend bool operator==(const LevelMesh&, const LevelMesh&) = default;
};

/// Everything a tree consists of, unpacked. Nodes are breadth-first, the children of a node contiguous, the root first.
struct SphereTreeData {
  std::vector<NodeData> nodes;                          ///< at least the root
  std::vector<Sphere> bounds;                           ///< of each node, tree frame; none: the nodes' balls bound too
  std::vector<Vec3> supportPoints;                      ///< tree frame
  std::vector<Vec3> faceNormals;                        ///< unit, tree frame
  std::vector<std::uint32_t> regionTriangles;           ///< indices into triangles
  std::vector<Vec3> vertices;                           ///< the source mesh, tree frame
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of the source mesh: indices into `vertices`
  std::vector<LevelMesh> levelMeshes;                   ///< of levels 1, 2 and so on; may be none
  Vec3d origin;         ///< of the tree frame, in the mesh's frame: the centre of mass rounded to float
  MassProperties mass;  ///< mesh frame
  BuildInfo info;       ///< how the tree came to be

  friend bool operator==(const SphereTreeData&, const SphereTreeData&) = default;
};

/// The certified sphere-tree: immutable, shared by all bodies of one shape, safe to read from any thread.
///
/// Hot data is one cache-aligned block of centres and radii per family of up to eight siblings, and half a cache line
/// per node; what only contacts or reports need is kept apart. Invariant, proved by the builder: every point of every
/// source triangle lies in a leaf all of whose ancestors contain it too; that is what makes pruning at a parent safe.
///
/// **Two spheres a node** (the hybrid trees of thesis 7.1.5). A node has a *sphere*, which answers, and a *bound*,
/// which traversals test. The invariant holds for both. Errors and inner radii are the sphere's: bounds traverse,
/// errors answer. In most trees each sphere is its own bound.
class CAIRN_CORE_EXPORT SphereTree {
 public:
  /// Checks everything a traversal relies on (order, links, finiteness, ranges) but not the cover, which needs the
  /// mesh: see the builder's `certify`. Fails with the first offending element. Linear.
  static Result<SphereTree> create(SphereTreeData data);

  /// All nodes, the root and the leaves included.
  std::uint32_t nodeCount() const { return static_cast<std::uint32_t>(data_.nodes.size()); }
  /// Levels below the root; 0 for a lone root.
  std::uint32_t depth() const { return depth_; }
  /// Nodes without children.
  std::uint32_t leafCount() const { return leafCount_; }

  /// All families, the root's own first.
  std::span<const Family> families() const { return families_; }
  /// One family, by its number.
  const Family& family(std::uint32_t index) const { return families_[index]; }
  /// The family of the node's children, 0 for a leaf (family 0 is the root's own).
  std::uint32_t childFamily(NodeId node) const { return traversalNodes_[node].childFamily; }
  /// Children of a node; 0 for a leaf.
  std::uint32_t childCount(NodeId node) const { return TraversalNode::count(traversalNodes_[node].childLanes); }
  /// Siblings in a family, 1 to `kFamilyWidth`.
  std::uint32_t familySize(std::uint32_t family) const { return familySize_[family]; }
  /// One bit per living lane of a family: what overlap bits are masked with, because between bodies at absurd distances
  /// even the lanes at infinity overlap.
  std::uint32_t livingLanes(std::uint32_t family) const { return (1U << familySize_[family]) - 1; }
  /// Whether a node has no children.
  bool isLeaf(NodeId node) const { return childFamily(node) == 0; }

  /// By NodeId; those of dead lanes are never to be read.
  std::span<const TraversalNode> traversalNodes() const { return traversalNodes_; }
  /// The nodes' own spheres, in the same places; of their numbers only these are to be read.
  std::span<const TraversalNode> answeringNodes() const {
    return answeringNodes_.empty() ? traversalNodes_ : answeringNodes_;
  }
  /// 2 where nodes have bounds of their own, else 1.
  std::uint32_t spheresPerNode() const { return answeringNodes_.empty() ? 1 : 2; }
  /// The node's ball, tree frame: what a traversal that stops here answers with.
  Sphere sphere(NodeId node) const {
    const TraversalNode& n = answeringNodes()[node];
    return {n.center, n.radius};
  }
  /// What traversals test in the node's place, tree frame: it holds the same region. The families consist of these.
  Sphere bound(NodeId node) const { return {traversalNodes_[node].center, traversalNodes_[node].radius}; }
  /// The node's certified error, tree unit: no point of its ball is farther from the solid.
  float error(NodeId node) const { return traversalNodes_[node].error; }
  /// Radius of the concentric ball inside the solid, tree unit; 0 where the centre is outside.
  float innerRadius(NodeId node) const { return traversalNodes_[node].innerRadius; }
  /// The node's extreme points in structure-of-arrays form, repeated to fill all lanes.
  const SupportBlock& support(NodeId node) const { return support_[node]; }

  /// The unpacked record of a node. Cold.
  const NodeData& node(NodeId node) const { return data_.nodes[recordIndex_[node]]; }
  /// Extreme points of the node's region, tree frame; one to `kMaxSupportPoints`.
  std::span<const Vec3> supportPoints(NodeId node) const;
  /// Unit normals of the region's flat faces, tree frame; at most `kMaxFaceNormals`.
  std::span<const Vec3> faceNormals(NodeId node) const;
  /// True for a leaf whose region consists of flat faces, with sharp edges between them, that `faceNormals` names
  /// without exception: every source triangle of it faces within 3 degrees of one of them, and no two of them within 30
  /// degrees of each other (the facets of a smooth body).
  bool isFaceted(NodeId node) const { return (flatness_[node] & kFaceted) != 0; }
  /// Whether the node's region lies in one plane, up to what a mesh's rounding does to its normals: all of them within
  /// 5 degrees of its cone's axis.
  bool isPlanar(NodeId node) const { return (flatness_[node] & kPlanar) != 0; }
  /// Source triangles that touch the node's region, as indices into `triangles()`.
  std::span<const std::uint32_t> regionTriangles(NodeId node) const;
  /// The source vertices of a leaf's region that its ball holds, as indices into `vertices()`, where its support points
  /// leave some out and they are no more than `kMaxRegionCorners`; else, and for inner nodes, nothing.
  std::span<const std::uint32_t> regionCorners(NodeId node) const {
    return std::span(corners_).subspan(firstCorner_[node], firstCorner_[node + 1] - firstCorner_[node]);
  }
  /// Levels between the root and a node; 0 for the root.
  std::uint32_t level(NodeId node) const { return level_[node]; }
  /// The node's name for its breadth-first number in `data().nodes`.
  NodeId nodeAt(std::uint32_t recordIndex) const { return nodeAt_[recordIndex]; }

  /// The cut of a traversal that stops at `level`: all nodes of that level and all leaves above it, breadth-first.
  std::vector<NodeId> levelCut(std::uint32_t level) const;
  /// Worst certified error over `levelCut(level)`.
  float levelError(std::uint32_t level) const;

  /// Vertices of the source mesh, tree frame.
  std::span<const Vec3> vertices() const { return data_.vertices; }
  /// Triangles of the source mesh: indices into `vertices()`, counter-clockwise seen from outside.
  std::span<const std::array<std::uint32_t, 3>> triangles() const { return data_.triangles; }
  /// How the source mesh hangs together, leaf by leaf.
  const TreeSurface& surface() const { return surface_; }
  /// The source mesh with the former. Valid as long as the tree.
  SurfaceView surfaceView() const { return {data_.vertices, data_.triangles, &surface_}; }
  /// Levels from 1 on that have a mesh of their own, coarser than the source; 0 if the builder made none.
  std::uint32_t levelMeshCount() const { return static_cast<std::uint32_t>(data_.levelMeshes.size()); }
  /// The mesh of a level, 1 to `levelMeshCount()`.
  const LevelMesh& levelMesh(std::uint32_t level) const { return data_.levelMeshes[level - 1]; }
  /// The same with what is derived from it. Valid as long as the tree.
  SurfaceView levelView(std::uint32_t level) const {
    return {levelMesh(level).vertices, levelMesh(level).triangles, &levelSurfaces_[level - 1]};
  }
  /// Volume, centre of mass and inertia of the solid, mesh frame.
  const MassProperties& mass() const { return data_.mass; }
  /// The tree frame's origin in the mesh's frame.
  const Vec3d& origin() const { return data_.origin; }
  /// How the tree came to be.
  const BuildInfo& info() const { return data_.info; }
  /// Everything the tree consists of, unpacked. Cold.
  const SphereTreeData& data() const { return data_; }
  /// How far a node's balls reach from the tree frame's origin, in its unit, to some roundings: nothing of the tree is
  /// farther out.
  float extent() const { return extent_; }
  /// Bytes of memory the tree holds, shared by all its bodies.
  std::size_t memoryBytes() const;

 private:
  friend class TreeRefit;  // moves the nodes of a copy that nobody else has seen
  static constexpr std::uint8_t kFaceted = 1, kPlanar = 2;

  explicit SphereTree(SphereTreeData data);
  void linkFamilies();
  void packNode(std::uint32_t record);
  void packBall(std::uint32_t record);
  void packFlatness(NodeId id);
  void packChildLanes(NodeId node);
  bool facesOnly(NodeId leaf) const;
  void listCorners();
  bool mayListCorners(NodeId node) const;
  bool areSupportPoints(std::span<const std::uint32_t> corners, NodeId leaf) const;

  SphereTreeData data_;
  std::vector<Family> families_;
  std::vector<TraversalNode> traversalNodes_;  // by NodeId, as are the arrays below it
  std::vector<TraversalNode> answeringNodes_;  // none where each sphere is its own bound
  std::vector<SupportBlock> support_;
  std::vector<std::uint32_t> recordIndex_;
  std::vector<std::uint8_t> level_;
  std::vector<std::uint8_t> flatness_;  // kFaceted, kPlanar: what contacts ask of each leaf, near each other
  std::vector<std::uint32_t> corners_, firstCorner_;  // those of node i from firstCorner_[i] to firstCorner_[i + 1]
  std::vector<std::uint8_t> familySize_;
  std::vector<NodeId> nodeAt_;
  TreeSurface surface_;
  std::vector<TreeSurface> levelSurfaces_;  // by level mesh
  float extent_ = 0;
  std::uint32_t depth_ = 0;
  std::uint32_t leafCount_ = 0;
};

}  // namespace cairn
