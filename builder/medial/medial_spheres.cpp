// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial_spheres.h"

#include <algorithm>
#include <queue>

#include "medial/voronoi_diagram.h"

namespace cairn::builder {

namespace {

/// Outside vertices farther from the middle than this many diagonals belong to the enclosing sites.
constexpr double kMaxReach = 1.0;

struct Judged {
  Ball ball;  // radius: distance to its sites
  Vec3d nearest;
  bool considered = false;  // finite, near the object, touches the region
};

struct QueuedVertex {
  double standOff;
  std::uint32_t index;

  friend bool operator<(const QueuedVertex& a, const QueuedVertex& b) {
    return a.standOff != b.standOff ? a.standOff < b.standOff : a.index > b.index;
  }
};

class AdaptiveSampling {
 public:
  AdaptiveSampling(const SignedDistance& solid, const PointSet& region, double spacing)
      : solid_(solid), region_(region), spacing_(spacing), bounds_(boundsOf(solid.mesh())), diagram_(bounds_) {}

  void run(std::span<const Vec3d> sites, const MedialGoal& goal) {
    for (const Vec3d& site : sites) diagram_.insert(site);
    judge(0);
    for (std::size_t n = 0; n < goal.maxInsertions; ++n) {
      dropDead();
      if (worst_.empty()) return;
      if (worst_.top().standOff <= goal.maxStandOff && aliveInside_ >= goal.minSpheres) return;
      refine(worst_.top().index);
    }
  }

  MedialSpheres result(const MedialGoal& goal) const {
    MedialSpheres result;
    std::vector<Ball> outside;
    const auto vertices = diagram_.vertices();
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (vertices[i].alive && judged_[i].considered)
        (isInside(i) ? result.inside : outside).push_back(judged_[i].ball);
    result.coverage = coverageSpheres(result.inside, outside);
    for (const Ball& ball : outside)
      if (-ball.depth <= goal.maxOutside) result.outside.push_back(ball);
    return result;
  }

 private:
  /// Looks at the vertices from `first` on.
  void judge(std::size_t first) {
    const auto vertices = diagram_.vertices();
    judged_.resize(vertices.size());
    for (std::size_t i = first; i < vertices.size(); ++i) {
      if (!vertices[i].alive) continue;
      judged_[i] = judged(vertices[i]);
      if (!judged_[i].considered || !(judged_[i].ball.depth > 0)) continue;
      worst_.push({judged_[i].ball.standOff(), static_cast<std::uint32_t>(i)});
      ++aliveInside_;
    }
  }

  Judged judged(const VoronoiVertex& vertex) {
    Judged j;
    if (!isFinite(vertex.position)) return j;
    for (const std::uint32_t site : vertex.sites)
      if (site < VoronoiDiagram::kEnclosingSites) return j;
    const double reach = distance(vertex.position, diagram_.site(vertex.sites[0]));
    if (reach > kMaxReach * bounds_.diagonal() || !region_.anyWithin(vertex.position, reach + spacing_)) return j;
    const SignedDistance::Answer answer = solid_.query(vertex.position, reach);  // its sites are on the surface
    return {{vertex.position, reach, answer.depth}, answer.nearest.point, true};
  }

  void dropDead() {
    while (!worst_.empty() && !diagram_.vertices()[worst_.top().index].alive) worst_.pop();
  }

  void refine(std::uint32_t index) {
    const Vec3d site = judged_[index].nearest;
    worst_.pop();
    // The surface point may be a site already (the sphere is as good as rounding allows): then it stays as it is.
    if (!diagram_.insert(site, index)) return;
    for (const std::uint32_t ended : diagram_.endedByLastInsert()) aliveInside_ -= isInside(ended) ? 1 : 0;
    judge(diagram_.firstOfLastInsert());
  }

  bool isInside(std::size_t index) const { return judged_[index].considered && judged_[index].ball.depth > 0; }

  /// For each point of the region that no inside sphere holds the outside sphere most easily removed by further
  /// sampling: the one with the largest reach over its distance from the surface, of those that hold the point.
  std::vector<Ball> coverageSpheres(const std::vector<Ball>& inside, const std::vector<Ball>& outside) const {
    std::vector<double> distances(region_.size());
    std::vector<bool> covered(region_.size(), false);
    for (const Ball& ball : inside) {
      region_.distances(ball.center, ball.radius, distances);
      for (std::size_t p = 0; p < covered.size(); ++p) covered[p] = covered[p] || distances[p] <= 0;
    }
    constexpr std::size_t kNone = ~std::size_t{0};
    std::vector<std::size_t> chosen(region_.size(), kNone);
    const auto deletability = [&](std::size_t i) { return outside[i].radius + outside[i].depth; };
    for (std::size_t i = 0; i < outside.size(); ++i) {
      region_.distances(outside[i].center, outside[i].radius, distances);
      for (std::size_t p = 0; p < covered.size(); ++p)
        if (!covered[p] && distances[p] <= 0 && (chosen[p] == kNone || deletability(i) > deletability(chosen[p])))
          chosen[p] = i;
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<Ball> coverage;
    for (const std::size_t i : chosen)
      if (i != kNone) coverage.push_back(outside[i]);
    return coverage;
  }

  const SignedDistance& solid_;
  const PointSet& region_;
  double spacing_;
  Bounds bounds_;
  VoronoiDiagram diagram_;
  std::vector<Judged> judged_;
  std::priority_queue<QueuedVertex> worst_;
  std::size_t aliveInside_ = 0;
};

}  // namespace

MedialSpheres approximateMedialAxis(const SignedDistance& solid, const PointSet& region, double spacing,
                                    std::span<const Vec3d> sites, const MedialGoal& goal) {
  AdaptiveSampling sampling(solid, region, spacing);
  sampling.run(sites, goal);
  return sampling.result(goal);
}

}  // namespace cairn::builder
