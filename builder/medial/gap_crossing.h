// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "medial/relaxed_samples.h"
#include "medial/voronoi_diagram.h"
#include "surface/planar_clusters.h"
#include "surface/triangle_hierarchy.h"

namespace cairn::builder {

/// New samples against the gap-crossing cells of a diagram (thesis 4.2): where the face between two cells meets a
/// cluster that does not hold both samples, those that are not on it are projected onto its plane; if none falls into a
/// triangle of the cluster, the first is snapped to its closest point there. Space is cut into cells of edge `spacing`;
/// a cell that has a sample gets no new one, which bounds how often this can be repeated.
///
/// `samples[i]` is site `VoronoiDiagram::kEnclosingSites + i`. One search of the hierarchy for each bounded face.
std::vector<ClusterSample> gapCrossingSamples(const VoronoiDiagram& diagram, const std::vector<ClusterSample>& samples,
                                              const TriangleMesh& mesh, const TriangleHierarchy& hierarchy,
                                              const PlanarClusters& clusters, double spacing);

}  // namespace cairn::builder
