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

/// A piece of a triangle for which the proof found no sphere. Mesh frame and unit.
struct UncoveredPiece {
  std::uint32_t triangle = 0;  ///< index in the mesh
  Vec3d point;                 ///< the middle of the piece
  double gap = 0;  ///< distance from the nearest sphere to the point; <= 0: the point is covered, but its surroundings
                   ///< are unproved
};

/// The proof for one level's cut: all nodes of the level and all leaves above it. A traversal that stops at this level
/// sees exactly this cut.
struct LevelCertificate {
  std::uint32_t level = 0;       ///< 0 is the root
  std::uint32_t spheres = 0;     ///< number of balls in the cut
  bool coverageProven = false;   ///< every point of every triangle lies in a ball of the cut
  bool reachableProven = false;  ///< every point also lies in all ancestors of such a ball
  double maxProtrusion = 0;  ///< upper bound of the distance from the solid to any point of the cut's balls; mesh unit
  double rmsProtrusion = 0;  ///< root mean square of that bound over the balls; mesh unit
  std::optional<UncoveredPiece> uncovered;    ///< present when coverage is not proven
  std::optional<UncoveredPiece> unreachable;  ///< present when reachability is not proven
};

/// The proof for one node. Mesh frame and unit.
struct NodeCertificate {
  double protrusionUpper = 0;  ///< no point of the ball is farther from the solid
  double protrusionLower = 0;  ///< `witness` is at least this far from the solid
  Vec3d witness;               ///< a point of the ball, see `protrusionLower`
  double depth = 0;            ///< of the centre below the surface; positive inside
  bool errorHolds = false;     ///< the stored error is not below `protrusionLower`
  bool errorProven = false;    ///< the stored error is not below `protrusionUpper`
  bool innerHolds = false;  ///< the stored inner radius is not above the depth, up to the rounding of a distance query
};

/// The complete result of `certify`: by level (0 = the root) and by node in breadth-first order.
struct Certificate {
  std::vector<LevelCertificate> levels;  ///< by level; 0 is the root
  std::vector<NodeCertificate> nodes;    ///< by node, breadth-first
  std::vector<std::string> records;      ///< one sentence for each other record of the tree that the mesh contradicts

  /// Returns one sentence per failure: the failure, its place and its amount. Empty when all is proved: every level
  /// covers the surface and is reachable, and no stored number is contradicted.
  std::vector<std::string> failures(const SphereTree& tree) const;
};

/// Proves, or refutes by a witness, that a sphere-tree bounds a mesh. The tree is not trusted and may come from any
/// source. Its spheres are taken as the exact reals of their floats, placed at the tree's origin. Where nodes have two
/// spheres, errors are proved of those that answer, and the cover of both: a point is covered by a node whose spheres
/// both hold it.
///
/// A triangle lies in a ball exactly when its corners do. A triangle that lies in no single chain of balls is split
/// until its pieces do. Pieces are split down to `kMinPiece` of the bounding box's diagonal. Branch and bound
/// encloses protrusions to 1 % or 1e-4 of the diagonal (certify/protrusion.h). All comparisons carry a guard for the
/// rounding of double arithmetic.
///
/// Other records are compared with the mesh. The stored mesh must be equal after rounding to float. Mass properties
/// must agree to 1e-9. Normal cones must hold the normals of their node's region triangles, and support points must lie
/// in their node's ball.
///
/// Two properties are not proved, because only contacts depend on them and no bound does. They are how well support
/// points and face normals represent their region, and whether a node lists every triangle of its region.
///
/// Precondition: `checkMesh(mesh)`. Fails only with `kCancelled`. Parallel; the result does not depend on the number of
/// threads. Takes about 0.1 s for 585 nodes on 1500 triangles.
///
///     Certificate certificate = certify(tree, mesh).value();
///     for (const std::string& failure : certificate.failures(tree)) report(failure);
Result<Certificate> certify(const SphereTree& tree, const TriangleMesh& mesh, const ProgressCallback& progress = {});

/// Pieces of a triangle are not split below this fraction of the mesh's bounding-box diagonal. A cover whose balls
/// overlap by less cannot be proved. Trees of `buildTree` can always be proved. Their balls hold the pieces of their
/// regions with a margin of 2^-23 of the largest coordinate (tree frame). The largest coordinate is at least 2^-1.8 of
/// the diagonal. So a ball that touches a piece of this length holds the whole piece.
inline constexpr double kMinPiece = 0x1p-25;

}  // namespace cairn::builder
