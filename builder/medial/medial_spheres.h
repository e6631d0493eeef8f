// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "balls/point_set.h"
#include "cairn/builder/ball.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// When the sampling of a region's medial axis is good enough (thesis 5.1 and 6.1).
struct MedialGoal {
  std::size_t minSpheres = 100;      ///< inside spheres that touch the region
  double maxStandOff = 0;            ///< of the worst of them, mesh units
  double maxOutside = 0;             ///< how far outside a centre may lie to be listed in `MedialSpheres::outside`
  std::size_t maxInsertions = 2000;  ///< gives up quietly: what was reached is still a valid set of candidates
  /// The spheres of `MedialSpheres::coverage` are improved as well, as in the thesis, and those kept in the end are the
  /// ones that stand off least. For whole solids, whose coverage is not reduced afterwards.
  bool improveCoverage = false;
};

/// Balls around Voronoi vertices of points of the surface; each passes through four of them and touches the region.
/// Sorted by vertex, so the order is as reproducible as the diagram.
struct MedialSpheres {
  std::vector<Ball> inside;    ///< centre inside the solid
  std::vector<Ball> coverage;  ///< outside ones that cover what `inside` leaves of the region (thesis Alg. 4)
  std::vector<Ball> outside;   ///< all outside ones no deeper outside than the goal asks for
  std::vector<Vec3d> sites;    ///< the points of the surface the diagram ended with
};

/// Approximates the part of the medial axis that matters to a region of the surface: a Voronoi diagram of `sites`,
/// refined by inserting the surface point closest to the worst-fitting inside vertex (thesis Alg. 3), which wherever
/// the region is one side of a limb also finds the other side.
///
/// `region`: points of the region's surface, at most `spacing` apart. `sites`: points of the surface, in the region and
/// near. Both in the mesh's frame. A pure function of its arguments.
MedialSpheres approximateMedialAxis(const SignedDistance& solid, const PointSet& region, double spacing,
                                    std::span<const Vec3d> sites, const MedialGoal& goal);

}  // namespace cairn::builder
