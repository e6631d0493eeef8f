// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/tree_surface.h"

namespace cairn {

/// The distance from a point to a surface, and its side.
struct SurfaceDepth {
  double depth = 0;            ///< positive inside; never more than the true one, up to rounding in doubles
  Vec3d away;                  ///< from the nearest point of the surface to the point asked for
  std::uint32_t triangle = 0;  ///< one that is nearest
};

/// Searches for the nearest triangle. The side is that of the angle-weighted normal there (Baerentzen and Aanaes 2005).
/// It is right for a closed mesh that does not intersect itself. A side in doubt counts as outside.
///
///     SurfaceDepthSearch search;
///     const double depth = search.at(tree.surfaceView(), point, 0).depth;
class CAIRN_CORE_EXPORT SurfaceDepthSearch {
 public:
  /// `guess`: a triangle that may be near; it does not change the depth. Triangles without area are passed over.
  SurfaceDepth at(const SurfaceView& surface, const Vec3& point, std::uint32_t guess);

 private:
  struct Waiting {
    float distanceSq;  // never more than the true one
    std::uint32_t child;
    bool isPatch;
  };
  std::vector<Waiting> waiting_;  // a member so that its memory serves many calls
};

}  // namespace cairn
