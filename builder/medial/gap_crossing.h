// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "medial/relaxed_samples.h"
#include "medial/voronoi_diagram.h"
#include "surface/planar_clusters.h"
#include "surface/triangle_hierarchy.h"

namespace cairn::builder {

/// Returns new samples that remove the gap-crossing cells of a diagram (thesis 4.2). Such a cell has a face that meets
/// a cluster without both samples of the face. Samples that are not on the cluster are projected onto its plane. If no
/// projection falls into a triangle of the cluster, the first is snapped to its closest point there. Space is divided
/// into cells of edge `spacing`. A cell with a sample gets no new one, which limits the number of repetitions.
///
/// `samples[i]` is site `VoronoiDiagram::kEnclosingSites + i`. Cost: one search of the hierarchy for each bounded face.
std::vector<ClusterSample> gapCrossingSamples(const VoronoiDiagram& diagram, const std::vector<ClusterSample>& samples,
                                              const TriangleMesh& mesh, const TriangleHierarchy& hierarchy,
                                              const PlanarClusters& clusters, double spacing);

}  // namespace cairn::builder
