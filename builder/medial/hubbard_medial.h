// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/progress.h"
#include "medial/relaxed_samples.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// Hubbard's approximation of the medial axis of a whole solid (thesis 4.1 to 4.3). All regions of a tree of Hubbard's
/// method use it. Mesh frame.
struct HubbardMedial {
  struct Sphere {
    Ball ball;  ///< around an inner Voronoi vertex, through its forming points
    std::array<std::uint32_t, 4> samples{};
    std::vector<std::uint32_t> neighbours;  ///< spheres that share three of its forming points, ascending
  };
  std::vector<ClusterSample> samples;
  std::vector<Vec3d> clusterNormals;
  std::vector<Sphere> spheres;
};

/// Samples the surface (`relaxedSamples`: about `samples` points, and those on edges). Then repairs gap-crossing cells
/// three times and keeps the spheres around inner vertices. A pure function. Expected O(n log n) in samples.
HubbardMedial hubbardMedialOf(
    const SignedDistance& solid, std::size_t samples, std::uint64_t seed,
    const KeepGoing& keepGoing = [] { return true; });

/// Builds the approximation from given samples, without sampling or repair: the inner vertices of their Voronoi
/// diagram. A sample lies on the clusters of all triangles within rounding of it. Precondition: the points lie on the
/// surface, none twice. O(samples times triangles).
HubbardMedial hubbardMedialFrom(const SignedDistance& solid, std::span<const Vec3d> samples);

}  // namespace cairn::builder
