// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/hubbard_medial.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "medial/gap_crossing.h"
#include "medial/voronoi_diagram.h"
#include "surface/edges.h"

namespace cairn::builder {

namespace {

constexpr int kRepairs = 3;
/// Edge of the cells in which gap-crossing repair puts at most one point, in spacings of an even distribution.
constexpr double kFinestRepair = 0.5;

/// The samples that are sites of the diagram. Coincident samples are dropped from both.
void insertAll(std::vector<ClusterSample> list, VoronoiDiagram& diagram, std::vector<ClusterSample>& samples,
               const KeepGoing& keepGoing) {
  constexpr std::size_t kPollEvery = 1024;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i % kPollEvery == 0 && !keepGoing()) return;
    if (diagram.insert(list[i].point)) samples.push_back(std::move(list[i]));
  }
}

/// Fraction of the diagonal, far above the rounding of a surface point and far below a mesh's details.
constexpr double kOnTriangle = 1e-9;

std::vector<std::uint32_t> clustersAt(const SignedDistance& solid, const PlanarClusters& clusters, const Vec3d& point) {
  const double within = solid.closest(point).distance + kOnTriangle * solid.bounds().diagonal();
  std::set<std::uint32_t> list;
  for (std::uint32_t t = 0; t < solid.mesh().triangles.size(); ++t)
    if (solid.distanceToTriangle(t, point) <= within) list.insert(clusters.ofTriangle[t]);
  return {list.begin(), list.end()};
}

double spacingOf(const TriangleMesh& mesh, std::size_t samples) {
  double area = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    area += 0.5 * length(cross(b - a, c - a));
  }
  return std::sqrt(area / static_cast<double>(samples));
}

void collectSpheres(const VoronoiDiagram& diagram, const SignedDistance& solid, HubbardMedial& medial) {
  constexpr std::uint32_t kFirst = VoronoiDiagram::kEnclosingSites;
  for (const VoronoiVertex& vertex : diagram.vertices()) {
    if (!vertex.alive || !isFinite(vertex.position)) continue;
    if (std::any_of(vertex.sites.begin(), vertex.sites.end(), [](std::uint32_t s) { return s < kFirst; })) continue;
    const double depth = solid.depth(vertex.position);
    if (!(depth > 0)) continue;
    HubbardMedial::Sphere sphere;
    sphere.ball = {vertex.position, distance(vertex.position, diagram.site(vertex.sites[0])), depth};
    for (int i = 0; i < 4; ++i) sphere.samples[i] = vertex.sites[i] - kFirst;
    std::sort(sphere.samples.begin(), sphere.samples.end());
    medial.spheres.push_back(std::move(sphere));
  }
}

/// Vertices of a Voronoi diagram are neighbours when they share three sites.
void findNeighbours(HubbardMedial& medial) {
  using Corner = std::pair<std::array<std::uint32_t, 3>, std::uint32_t>;
  std::vector<Corner> triples;
  for (std::uint32_t i = 0; i < medial.spheres.size(); ++i) {
    const auto& s = medial.spheres[i].samples;
    triples.push_back({{s[0], s[1], s[2]}, i});
    triples.push_back({{s[0], s[1], s[3]}, i});
    triples.push_back({{s[0], s[2], s[3]}, i});
    triples.push_back({{s[1], s[2], s[3]}, i});
  }
  std::sort(triples.begin(), triples.end());
  for (std::size_t i = 1; i < triples.size(); ++i) {
    if (triples[i].first != triples[i - 1].first) continue;
    medial.spheres[triples[i].second].neighbours.push_back(triples[i - 1].second);
    medial.spheres[triples[i - 1].second].neighbours.push_back(triples[i].second);
  }
  for (HubbardMedial::Sphere& sphere : medial.spheres) std::sort(sphere.neighbours.begin(), sphere.neighbours.end());
}

}  // namespace

HubbardMedial hubbardMedialOf(const SignedDistance& solid, std::size_t samples, std::uint64_t seed,
                              const KeepGoing& keepGoing) {
  const TriangleMesh& mesh = solid.mesh();
  const std::vector<HalfEdge> halfEdges = sortedHalfEdges(mesh);
  const PlanarClusters clusters = planarClustersOf(mesh, halfEdges);
  const TriangleHierarchy hierarchy(mesh);
  const double finest = kFinestRepair * spacingOf(mesh, samples);
  HubbardMedial medial;
  medial.clusterNormals = clusters.normals;
  VoronoiDiagram diagram(boundsOf(mesh));
  insertAll(relaxedSamples(mesh, halfEdges, clusters, samples, seed), diagram, medial.samples, keepGoing);
  for (int repair = 0; repair < kRepairs; ++repair) {
    auto added = gapCrossingSamples(diagram, medial.samples, mesh, hierarchy, clusters, finest);
    if (added.empty()) break;
    insertAll(std::move(added), diagram, medial.samples, keepGoing);
    if (!keepGoing()) return medial;
  }
  collectSpheres(diagram, solid, medial);
  findNeighbours(medial);
  return medial;
}

HubbardMedial hubbardMedialFrom(const SignedDistance& solid, std::span<const Vec3d> samples) {
  const TriangleMesh& mesh = solid.mesh();
  const PlanarClusters clusters = planarClustersOf(mesh, sortedHalfEdges(mesh));
  std::vector<ClusterSample> list;
  for (const Vec3d& sample : samples) list.push_back({sample, clustersAt(solid, clusters, sample)});
  HubbardMedial medial;
  medial.clusterNormals = clusters.normals;
  VoronoiDiagram diagram(boundsOf(mesh));
  insertAll(std::move(list), diagram, medial.samples, [] { return true; });
  collectSpheres(diagram, solid, medial);
  findNeighbours(medial);
  return medial;
}

}  // namespace cairn::builder
