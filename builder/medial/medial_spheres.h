// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "balls/point_set.h"
#include "cairn/builder/ball.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// The end condition for the sampling of a region's medial axis (thesis 5.1 and 6.1).
struct MedialGoal {
  std::size_t minSpheres = 100;      ///< inside spheres that touch the region
  double maxStandOff = 0;            ///< largest allowed stand-off of these, mesh units
  double maxOutside = 0;             ///< largest distance outside for centres in `MedialSpheres::outside`; mesh units
  std::size_t maxInsertions = 2000;  ///< ends here without failure: the spheres found are valid candidates
  /// Also improves the spheres of `MedialSpheres::coverage`, as in the thesis, and keeps those with the least
  /// stand-off. For whole solids, whose coverage is not reduced afterwards.
  bool improveCoverage = false;
};

/// Balls around Voronoi vertices of surface points. Each passes through four of the points and touches the region. The
/// balls are sorted by vertex, so their order is as reproducible as the diagram.
struct MedialSpheres {
  std::vector<Ball> inside;  ///< centre inside the solid
  std::vector<Ball>
      coverage;  ///< centre outside; they cover the part of the region that `inside` leaves (thesis Alg. 4)
  std::vector<Ball> outside;  ///< all balls with a centre outside by at most `maxOutside`
  std::vector<Vec3d> sites;   ///< the sites of the final diagram, points of the surface
};

/// Approximates the part of the medial axis that matters to a region of the surface. A Voronoi diagram of `sites` is
/// refined by new surface points. Each is the point closest to the worst-fitting inside vertex (thesis Alg. 3). Where
/// the region is one side of a limb, this also finds the other side.
///
/// `region`: points of the region's surface, at most `spacing` apart. `sites`: points of the surface, in the region and
/// near it. Both in the mesh's frame. A pure function of its arguments.
MedialSpheres approximateMedialAxis(const SignedDistance& solid, const PointSet& region, double spacing,
                                    std::span<const Vec3d> sites, const MedialGoal& goal);

}  // namespace cairn::builder
