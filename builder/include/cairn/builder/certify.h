// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// A piece of a triangle for which no sphere could be found. Mesh frame and unit.
struct UncoveredPiece {
  std::uint32_t triangle = 0;  ///< of the mesh
  Vec3d point;                 ///< the middle of the piece
  double gap = 0;  ///< how far the point lies outside the nearest sphere; <= 0: covered, but its surroundings unproved
};

/// What is proved about the cut a traversal stopped at one level sees: all nodes of the level and all leaves above it.
struct LevelCertificate {
  std::uint32_t level = 0;       ///< 0 is the root
  std::uint32_t spheres = 0;     ///< in the cut
  bool coverageProven = false;   ///< every point of every triangle lies in a ball of the cut
  bool reachableProven = false;  ///< and in all ancestors of that ball
  double maxProtrusion = 0;  ///< upper bound of the farthest any ball of the cut reaches outside the solid, mesh unit
  double rmsProtrusion = 0;  ///< root of the mean over the balls of the square of that bound
  std::optional<UncoveredPiece> uncovered;    ///< when coverage is not proven
  std::optional<UncoveredPiece> unreachable;  ///< when reachability is not proven
};

/// What is proved about one node. Mesh frame and unit.
struct NodeCertificate {
  double protrusionUpper = 0;  ///< no point of the ball is farther from the solid
  double protrusionLower = 0;  ///< `witness`, a point of the ball, is at least this far
  Vec3d witness;               ///< a point of the ball, see `protrusionLower`
  double depth = 0;            ///< of the centre: positive inside
  bool errorHolds = false;     ///< the stored error is not below `protrusionLower`
  bool errorProven = false;    ///< the stored error is not below `protrusionUpper`
  bool innerHolds = false;  ///< the stored inner radius is not above the depth, up to the rounding of a distance query
};

/// Everything `certify` found, by level (0 = the root) and by node in breadth-first order.
struct Certificate {
  std::vector<LevelCertificate> levels;  ///< by level, 0 is the root
  std::vector<NodeCertificate> nodes;    ///< by node, breadth-first
  std::vector<std::string> records;      ///< what else the tree keeps and the mesh contradicts, one sentence each

  /// Empty when all is proved: cover and reachability of every level, and no stored number contradicted. Otherwise one
  /// sentence per failure: what, where and by how much.
  std::vector<std::string> failures(const SphereTree& tree) const;
};

/// Proves, or refutes by a witness, that a sphere-tree bounds a mesh. The tree is not trusted and may come from
/// anywhere; its spheres are taken as the exact reals their floats are, placed at the tree's origin.
///
/// A triangle lies in a ball exactly when its corners do; one that lies in no single chain of balls is split until its
/// pieces do, down to `kMinPiece` of the bounding box's diagonal. Protrusions are enclosed by branch and bound to
/// 1 % or 1e-4 of the diagonal (certify/protrusion.h). All comparisons carry a guard for the rounding of double
/// arithmetic.
///
/// Also compared with the mesh: the stored mesh (equal, rounded to float), mass properties (to 1e-9), normal cones
/// (hold the normals of the node's region triangles), support points (in their node's ball). Not proved, because only
/// contacts rest on them and no bound does: that support points and face normals stand well for their region, and that
/// a node names every triangle of its region.
///
/// Precondition: `checkMesh(mesh)`. Fails only with `kCancelled`. Parallel; the result does not depend on the number of
/// threads. About 0.1 s for 585 nodes on 1500 triangles.
Result<Certificate> certify(const SphereTree& tree, const TriangleMesh& mesh, const ProgressCallback& progress = {});

/// Pieces of a triangle are not split below this fraction of the mesh's bounding-box diagonal: a cover whose balls
/// overlap by less cannot be proved. What `buildTree` makes always can: its balls hold the pieces of their regions with
/// 2^-23 of the largest coordinate to spare (tree frame), which is at least 2^-1.8 of the diagonal, and a piece no
/// longer than that is held wherever it touches.
inline constexpr double kMinPiece = 0x1p-25;

}  // namespace cairn::builder
