// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/relaxed_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "surface/random_stream.h"

namespace cairn::builder {

namespace {

constexpr int kRelaxations = 10;
/// Range of the repulsion in spacings of an even distribution, and the fraction of it by which a near pair is pushed
/// apart.
constexpr double kReach = 2, kPush = 0.15;
/// Number of points between corners, as a multiple of the requested points. A needle has very many spacings along its
/// edges for its area.
constexpr double kMaxOnEdges = 4;

double areaOf(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = mesh.corners(triangle);
  return 0.5 * length(cross(b - a, c - a));
}

class Sampling {
 public:
  Sampling(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges, const PlanarClusters& clusters,
           std::size_t count)
      : mesh_(mesh), halfEdges_(halfEdges), clusters_(clusters), count_(count), byCluster_(clusters.count()) {
    double area = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) area += areaOf(mesh, t);
    spacing_ = std::sqrt(area / static_cast<double>(count));
  }

  std::vector<ClusterSample> run(std::uint64_t seed) {
    addEdges();
    still_ = samples_.size();
    scatter(seed);
    for (int i = 0; i < kRelaxations; ++i)
      for (std::uint32_t cluster = 0; cluster < byCluster_.size(); ++cluster) relax(cluster);
    return std::move(samples_);
  }

 private:
  void add(const Vec3d& point, const std::set<std::uint32_t>& clusters) {
    for (const std::uint32_t c : clusters) byCluster_[c].push_back(samples_.size());
    samples_.push_back({point, {clusters.begin(), clusters.end()}});
  }

  /// Calls `visit(one end, the other, clusters)` for every edge between clusters.
  template <class Visit>
  void visitEdges(const Visit& visit) const {
    for (std::size_t first = 0, end = 0; first < halfEdges_.size(); first = end) {
      std::set<std::uint32_t> sides;
      for (end = first; end < halfEdges_.size() && halfEdges_[end].sameEdge(halfEdges_[first]); ++end)
        sides.insert(clusters_.ofTriangle[halfEdges_[end].triangle]);
      if (sides.size() >= 2) visit(halfEdges_[first].low(), halfEdges_[first].high(), sides);
    }
  }

  /// Largest distance between neighbouring points along the edges.
  double edgeSpacing() const {
    double points = 0;
    visitEdges([&](std::uint32_t from, std::uint32_t to, const auto&) {
      points += std::floor(distance(mesh_.vertices[from], mesh_.vertices[to]) / spacing_);
    });
    return spacing_ * std::max(points / (kMaxOnEdges * static_cast<double>(count_)), 1.0);
  }

  /// Corners and edges between clusters.
  void addEdges() {
    const double spacing = edgeSpacing();
    std::vector<std::set<std::uint32_t>> atVertex(mesh_.vertices.size());
    visitEdges([&](std::uint32_t low, std::uint32_t high, const std::set<std::uint32_t>& sides) {
      const Vec3d from = mesh_.vertices[low], to = mesh_.vertices[high];
      const auto cells = static_cast<int>(std::ceil(distance(from, to) / spacing));
      for (int i = 1; i < cells; ++i) add(from + (to - from) * (static_cast<double>(i) / cells), sides);
      atVertex[low].insert(sides.begin(), sides.end());
      atVertex[high].insert(sides.begin(), sides.end());
    });
    for (std::size_t v = 0; v < atVertex.size(); ++v)
      if (!atVertex[v].empty()) add(mesh_.vertices[v], atVertex[v]);
  }

  /// The probability of a triangle is proportional to its area; a position in it is uniform.
  void scatter(std::uint64_t seed) {
    std::vector<std::uint32_t> order(mesh_.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return areaOf(mesh_, a) < areaOf(mesh_, b); });
    std::vector<double> sums;
    double sum = 0;
    for (const std::uint32_t t : order) sums.push_back(sum += areaOf(mesh_, t));
    RandomStream random(seed, 0);
    for (std::size_t i = 0; i < count_; ++i) {
      const auto place = std::upper_bound(sums.begin(), sums.end() - 1, random.uniform() * sum);
      const std::uint32_t t = order[static_cast<std::size_t>(place - sums.begin())];
      const double u = std::sqrt(random.uniform()), v = random.uniform();
      const auto [a, b, c] = mesh_.corners(t);
      add(a * (1 - u) + b * (u * (1 - v)) + c * (u * v), {clusters_.ofTriangle[t]});
    }
  }

  /// One sweep: the neighbours of each free point in its cluster push the point, unless the new position is off the
  /// cluster.
  void relax(std::uint32_t cluster) {
    const double reach = kReach * spacing_;
    for (const std::size_t i : byCluster_[cluster]) {
      if (i < still_) continue;
      Vec3d push;
      for (const std::size_t k : byCluster_[cluster]) {
        const Vec3d away = samples_[i].point - samples_[k].point;
        const double d = length(away);
        if (d > 0 && d < reach) push += away * ((reach - d) / d);
      }
      const Vec3d moved = samples_[i].point + push * kPush;
      if (const auto onto = ontoCluster(cluster, moved)) samples_[i].point = *onto;
    }
  }

  std::optional<Vec3d> ontoCluster(std::uint32_t cluster, const Vec3d& point) const {
    for (const std::uint32_t t : clusters_.triangles[cluster]) {
      const auto [a, b, c] = mesh_.corners(t);
      const Vec3d normal = cross(b - a, c - a);
      const double twiceAreaSq = lengthSq(normal);
      const double wa = dot(cross(c - b, point - b), normal), wb = dot(cross(a - c, point - c), normal),
                   wc = dot(cross(b - a, point - a), normal);
      if (wa >= 0 && wb >= 0 && wc >= 0) return (a * wa + b * wb + c * wc) / twiceAreaSq;
    }
    return std::nullopt;
  }

  const TriangleMesh& mesh_;
  const std::vector<HalfEdge>& halfEdges_;
  const PlanarClusters& clusters_;
  std::size_t count_;
  std::vector<std::vector<std::size_t>> byCluster_;
  double spacing_ = 0;
  std::vector<ClusterSample> samples_;
  std::size_t still_ = 0;  // samples before this one lie on edges
};

}  // namespace

bool ClusterSample::liesOn(std::uint32_t cluster) const {
  return std::binary_search(clusters.begin(), clusters.end(), cluster);
}

std::vector<ClusterSample> relaxedSamples(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges,
                                          const PlanarClusters& clusters, std::size_t count, std::uint64_t seed) {
  return Sampling(mesh, halfEdges, clusters, count).run(seed);
}

}  // namespace cairn::builder
