// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// How the surface is sampled for a Voronoi diagram whose inner vertices stand for the medial axis.
enum class MedialSampling : std::uint8_t {
  regular,   ///< Hubbard's: spread evenly, by relaxation, and repaired where cells cross gaps (thesis 4.1 and 4.2)
  adaptive,  ///< where the worst-fitting sphere touches nothing, one after another (5.1, Alg. 3 and 4)
};

/// Balls around the vertices of a Voronoi diagram of points of a whole solid's surface, each through four of these
/// points. Mesh frame and unit.
struct MedialAxis {
  std::vector<Vec3d> samples;  ///< what the diagram is of
  std::vector<Ball> inside;    ///< centre inside the solid
  /// Centre outside: they hold those of `surface` that no ball of `inside` does, up to rounding, at the least
  /// stand-off. Of adaptive sampling only, which improves them as it does the others (5.2).
  std::vector<Ball> coverage;
  std::vector<Vec3d> surface;  ///< spread over the surface: the corners of the pieces sets of balls are to cover

  /// Those inside, then those of `coverage`: what reductions start from.
  std::vector<Ball> balls() const;
};

/// How `medialAxis` samples the surface. Values out of range are refused by it.
struct MedialAxisOptions {
  MedialSampling sampling = MedialSampling::adaptive;  ///< which construction
  /// Regular: this many besides those on the edges between planar parts and those of the repair. Adaptive: at most this
  /// many and at least about 95 % of them, the first 60 spread evenly. At least 8, at most 1e5.
  std::uint32_t samples = 2000;
  std::uint32_t spheres = 0;  ///< adaptive: ends once so many are inside, and those of `coverage` no worse; 0: goes on
  std::uint32_t surfacePieces = 5000;  ///< of the surface to be covered, about; 100..1e6
  std::uint64_t seed = 1;              ///< of all that is drawn at random
};

/// The medial axis of a solid as the two constructions of the thesis see it. Trees are built from the axes of regions
/// (see `buildTree`); this is to compare and to reduce whole ones. A pure function. Fails for options out of range, for
/// a mesh `checkMesh` refuses, and with `kCancelled`. Regular: expected O(n log n); adaptive: a pass over `surface` for
/// each vertex of the diagram that ever was, some 20 for each sample.
Result<MedialAxis> medialAxis(const TriangleMesh& mesh, const MedialAxisOptions& options,
                              const ProgressCallback& progress = {});

}  // namespace cairn::builder
