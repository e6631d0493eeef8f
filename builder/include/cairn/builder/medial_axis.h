// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// The way the surface is sampled for a Voronoi diagram. The diagram's inner vertices approximate the medial axis.
enum class MedialSampling : std::uint8_t {
  regular,   ///< Hubbard's: spread evenly by relaxation, repaired where cells cross gaps (thesis 4.1 and 4.2)
  adaptive,  ///< one sample after another, where the worst-fitting sphere touches nothing (5.1, Alg. 3 and 4)
};

/// Balls around the vertices of a Voronoi diagram of points on a whole solid's surface. Each ball passes through four
/// of these points. Mesh frame and unit.
struct MedialAxis {
  std::vector<Vec3d> samples;  ///< the sites of the diagram
  std::vector<Ball> inside;    ///< centre inside the solid
  /// Balls with their centre outside the solid. They hold the points of `surface` that no ball of `inside` holds, up to
  /// rounding, at the least stand-off. Filled by adaptive sampling only, which improves them together with the others
  /// (5.2).
  std::vector<Ball> coverage;
  std::vector<Vec3d> surface;  ///< spread over the surface: corners of the pieces that sets of balls must cover

  /// The balls of `inside`, followed by those of `coverage`. Reductions start from this set.
  std::vector<Ball> balls() const;
};

/// The sampling of `medialAxis`, which refuses values out of range.
struct MedialAxisOptions {
  MedialSampling sampling = MedialSampling::adaptive;  ///< one of the two constructions
  /// Regular: this many samples, beside those on edges between planar parts and those of the repair. Adaptive: at most
  /// this many and at least about 95 % of them; the first 60 are spread evenly. Range 8..1e5.
  std::uint32_t samples = 2000;
  std::uint32_t spheres = 0;  ///< adaptive: ends once so many are inside and `coverage` fits no worse; 0: no such end
  std::uint32_t surfacePieces = 5000;  ///< approximate number of surface pieces to be covered; 100..1e6
  std::uint64_t seed = 1;              ///< of all random choices
};

/// Computes the medial axis of a solid by one of the thesis's two constructions. It serves to compare and reduce whole
/// axes; trees are built from the axes of regions (see `buildTree`). A pure function. Fails for options out of range,
/// for a mesh that `checkMesh` refuses, and with `kCancelled`. Cost of regular sampling: expected O(n log n). Cost of
/// adaptive sampling: one pass over `surface` for each vertex that ever existed in the diagram, some 20 for each
/// sample.
///
///     MedialAxis axis = medialAxis(mesh, {.samples = 1000}).value();
///     std::vector<Ball> eight = reduceBalls(mesh, axis, {.count = 8}).value();
Result<MedialAxis> medialAxis(const TriangleMesh& mesh, const MedialAxisOptions& options,
                              const ProgressCallback& progress = {});

}  // namespace cairn::builder
