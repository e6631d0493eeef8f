// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// Two pieces that touch across a cut.
struct Bond {
  std::uint32_t first = 0, second = 0;  ///< first < second
  double area = 0;                      ///< area of the cut, mesh unit squared

  friend bool operator==(const Bond&, const Bond&) = default;
};

/// A solid cut into the branches of its sphere-tree. Mesh frame and unit.
struct Fracture {
  std::vector<TriangleMesh> pieces;     ///< each passes `checkMesh`; together they fill the solid
  std::vector<std::uint32_t> branches;  ///< for each piece: the index (from 0) of the root's child it belongs to
  std::vector<Bond> bonds;              ///< pairs of pieces that touch across a cut, in ascending order
  double volumeError = 0;               ///< |sum of the pieces' volumes - the solid's| / the solid's
};

/// The largest `volumeError` that `fracture` accepts; a relative volume.
inline constexpr double kMaxVolumeError = 1e-9;

/// Cuts a solid where the branches of its tree meet (thesis 8.3.5: objects that break along their sphere-trees). Each
/// child of the root gets the points of the solid whose power distance to its sphere is least. The cuts are therefore
/// near the planes in which neighbouring spheres meet (Aurenhammer 1987). Radii are changed by a thousandth, so that
/// cuts of symmetric solids do not run through corners. A branch whose part falls apart becomes several pieces.
///
/// Fails for a mesh that `checkMesh` refuses, for a tree with fewer than two branches, and with `kCancelled`. Also
/// fails when four attempts with different radii give no cuts that are closed and free of self-intersections.
/// Predicates are exact, but corners are rounded to doubles.
///
/// Precondition: `tree` was built on `mesh`. Single thread. Cost: O(b^2 n log n) for b branches. The result has the
/// same bits every time.
///
///     Fracture parts = fracture(mesh, tree).value();
///     for (const TriangleMesh& piece : parts.pieces) trees.push_back(buildTree(piece, options).value());
Result<Fracture> fracture(const TriangleMesh& mesh, const SphereTree& tree, const ProgressCallback& progress = {});

}  // namespace cairn::builder
