// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// Two pieces that were one across a cut.
struct Bond {
  std::uint32_t first = 0, second = 0;  ///< first < second
  double area = 0;                      ///< of the cut, mesh unit squared

  friend bool operator==(const Bond&, const Bond&) = default;
};

/// A solid cut into the branches of its sphere-tree. Mesh frame and unit.
struct Fracture {
  std::vector<TriangleMesh> pieces;     ///< each passes `checkMesh`; together they are the solid
  std::vector<std::uint32_t> branches;  ///< of each piece: the root's child it belongs to, counted from 0
  std::vector<Bond> bonds;              ///< of pieces that touch across a cut, in order
  double volumeError = 0;               ///< |sum of the pieces' volumes - the solid's| / the solid's
};

/// The largest `volumeError` that is let pass.
inline constexpr double kMaxVolumeError = 1e-9;

/// Cuts a solid where the branches of its tree meet (thesis 8.3.5: objects that break along their sphere-trees). Each
/// child of the root gets the points of the solid whose power distance to its sphere is least, so that cuts are about
/// the planes in which neighbouring spheres meet (Aurenhammer 1987; radii are changed by a thousandth, lest cuts of
/// symmetric solids run through corners), and what a branch holds apart becomes several pieces.
///
/// Fails for a mesh `checkMesh` refuses, for a tree with fewer than two branches, when cuts do not come out closed and
/// free of self-intersections (exact predicates, but corners are rounded to doubles) in four attempts with other radii,
/// and with `kCancelled`.
/// Precondition: `tree` was built on `mesh`. Single thread; branches squared times n log n. The same bits every time.
Result<Fracture> fracture(const TriangleMesh& mesh, const SphereTree& tree, const ProgressCallback& progress = {});

}  // namespace cairn::builder
