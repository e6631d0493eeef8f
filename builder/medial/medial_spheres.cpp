// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial_spheres.h"

#include <algorithm>
#include <optional>
#include <queue>
#include <utility>

#include "balls/depth_field.h"
#include "medial/voronoi_diagram.h"

namespace cairn::builder {

namespace {

/// Outside vertices farther from the middle than this many diagonals belong to the enclosing sites.
constexpr double kMaxReach = 1.0;

/// Largest number of times that improved coverage is computed anew.
constexpr std::size_t kRounds = 1000;
/// It ends within this last fraction of its insertions, as soon as no coverage is worse than the medial spheres.
constexpr std::size_t kEnding = 20;

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
    if (goal.improveCoverage) {
      holders_.assign(region_.size(), 0);
      slack_ = kRoundingRoom * bounds_.diagonal();
    }
    judge(0);
    const std::size_t ending = goal.maxInsertions - goal.maxInsertions / kEnding;
    const std::size_t round = std::max(std::size_t{1}, goal.maxInsertions / kRounds);
    for (std::size_t n = 0; n < goal.maxInsertions; ++n) {
      if (goal.improveCoverage && (n % round == 0 || n >= ending)) queueCoverage();
      if (bare_) {
        sampleBarePoint();
        continue;
      }
      dropDead();
      if (worst_.empty()) return;
      if (reached(goal) || (goal.improveCoverage && n >= ending && isInside(worst_.top().index))) return;
      refine(worst_.top().index);
    }
  }

  MedialSpheres result(const MedialGoal& goal) const {
    MedialSpheres result;
    const auto [inside, outside] = living();
    for (const std::uint32_t i : inside) result.inside.push_back(judged_[i].ball);
    const Preference preference = goal.improveCoverage ? Preference::leastStandOff : Preference::mostDeletable;
    for (const std::uint32_t i : eachOnce(coverageOf(uncoveredBy(inside), outside, preference)))
      result.coverage.push_back(judged_[i].ball);
    for (const std::uint32_t i : outside)
      if (-judged_[i].ball.depth <= goal.maxOutside) result.outside.push_back(judged_[i].ball);
    for (std::uint32_t i = VoronoiDiagram::kEnclosingSites; i < diagram_.siteCount(); ++i)
      result.sites.push_back(diagram_.site(i));
    return result;
  }

 private:
  /// Examines the vertices from `first` on.
  void judge(std::size_t first) {
    const auto vertices = diagram_.vertices();
    judged_.resize(vertices.size());
    for (std::size_t i = first; i < vertices.size(); ++i) {
      if (!vertices[i].alive) continue;
      judged_[i] = judged(vertices[i]);
      if (!judged_[i].considered || !(judged_[i].ball.depth > 0)) continue;
      worst_.push({judged_[i].ball.standOff(), static_cast<std::uint32_t>(i)});
      ++aliveInside_;
      countHolder(judged_[i].ball, true);
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

  /// Improved coverage must not be worse than the medial spheres.
  bool reached(const MedialGoal& goal) const {
    const QueuedVertex& worst = worst_.top();
    return worst.standOff <= goal.maxStandOff && aliveInside_ >= goal.minSpheres &&
           (!goal.improveCoverage || isInside(worst.index));
  }

  void dropDead() {
    while (!worst_.empty() && !diagram_.vertices()[worst_.top().index].alive) worst_.pop();
  }

  void refine(std::uint32_t index) {
    const Vec3d site = judged_[index].nearest;
    worst_.pop();
    // The surface point may be a site already, when the sphere is as good as rounding allows. Then the sphere stays
    // unchanged.
    if (diagram_.insert(site, index)) updateAfterInsert();
  }

  void updateAfterInsert() {
    for (const std::uint32_t ended : diagram_.endedByLastInsert()) {
      if (!isInside(ended)) continue;
      --aliveInside_;
      countHolder(judged_[ended].ball, false);
    }
    judge(diagram_.firstOfLastInsert());
  }

  bool isInside(std::size_t index) const { return judged_[index].considered && judged_[index].ball.depth > 0; }

  /// The rule that chooses the outside sphere for a point that no inside sphere holds.
  enum class Preference {
    mostDeletable,  ///< the one that further sampling removes most easily: the largest reach over its distance outside
    leastStandOff,
  };

  using Indices = std::vector<std::uint32_t>;

  /// The considered spheres, inside and outside, by vertex.
  std::pair<Indices, Indices> living() const {
    std::pair<Indices, Indices> list;
    const auto vertices = diagram_.vertices();
    for (std::uint32_t i = 0; i < vertices.size(); ++i)
      if (vertices[i].alive && judged_[i].considered) (isInside(i) ? list.first : list.second).push_back(i);
    return list;
  }

  /// Points of the region that lie in none of these spheres.
  Indices uncoveredBy(const Indices& inside) const {
    std::vector<double> distances(region_.size());
    std::vector<bool> covered(region_.size(), false);
    for (const std::uint32_t i : inside) {
      region_.distances(judged_[i].ball.center, judged_[i].ball.radius, distances);
      for (std::size_t p = 0; p < covered.size(); ++p) covered[p] = covered[p] || distances[p] <= slack_;
    }
    Indices list;
    for (std::uint32_t p = 0; p < covered.size(); ++p)
      if (!covered[p]) list.push_back(p);
    return list;
  }

  static constexpr std::uint32_t kNone = ~0U;

  /// For each of these points: the preferred outside sphere among those that hold it, or `kNone`.
  Indices coverageOf(const Indices& uncovered, const Indices& outside, Preference preference) const {
    PointSet points;
    points.assign(region_, uncovered);
    std::vector<double> distances(points.size());
    Indices chosen(points.size(), kNone);
    const auto merit = [&](std::uint32_t i) {
      const Ball& ball = judged_[i].ball;
      return preference == Preference::mostDeletable ? ball.radius + ball.depth : -ball.standOff();
    };
    for (const std::uint32_t i : outside) {
      points.distances(judged_[i].ball.center, judged_[i].ball.radius, distances);
      for (std::size_t p = 0; p < chosen.size(); ++p)
        if (distances[p] <= slack_ && (chosen[p] == kNone || merit(i) > merit(chosen[p]))) chosen[p] = i;
    }
    return chosen;
  }

  /// Ascending, without `kNone`.
  static Indices eachOnce(Indices chosen) {
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    if (!chosen.empty() && chosen.back() == kNone) chosen.pop_back();
    return chosen;
  }

  /// Lets the present coverage compete with the inside spheres for refinement.
  void queueCoverage() {
    Indices uncovered;
    for (std::uint32_t p = 0; p < holders_.size(); ++p)
      if (holders_[p] == 0) uncovered.push_back(p);
    if (uncovered.empty()) return;
    const Indices chosen = coverageOf(uncovered, living().second, Preference::mostDeletable);
    for (const std::uint32_t i : eachOnce(chosen)) worst_.push({judged_[i].ball.standOff(), i});
    const auto none = std::find(chosen.begin(), chosen.end(), kNone);
    if (none != chosen.end()) bare_ = uncovered[static_cast<std::size_t>(none - chosen.begin())];
  }

  /// A point that only spheres of enclosing sites hold, such as the tip of a spike, becomes a sample itself. Then
  /// spheres touch it.
  void sampleBarePoint() {
    holders_[*bare_] += kTouched;
    if (diagram_.insert(region_[*bare_])) updateAfterInsert();
    bare_.reset();
  }

  /// Adds an inside sphere to the holders of its points, or removes it, if holders are counted.
  void countHolder(const Ball& ball, bool in) {
    if (holders_.empty()) return;
    distances_.resize(region_.size());
    region_.distances(ball.center, ball.radius, distances_);
    for (std::size_t p = 0; p < holders_.size(); ++p)
      if (distances_[p] <= slack_) holders_[p] += in ? 1 : -1;
  }

  const SignedDistance& solid_;
  const PointSet& region_;
  double spacing_;
  Bounds bounds_;
  VoronoiDiagram diagram_;
  std::vector<Judged> judged_;
  std::priority_queue<QueuedVertex> worst_;
  std::size_t aliveInside_ = 0;
  std::vector<int> holders_;  // by point: living inside spheres that hold it; empty when coverage is not improved
  double slack_ = 0;          // a sphere that touches a point up to rounding holds it
  std::vector<double> distances_;
  std::optional<std::uint32_t> bare_;  // a point that no sphere holds
  static constexpr int kTouched = 1 << 20;
};

}  // namespace

MedialSpheres approximateMedialAxis(const SignedDistance& solid, const PointSet& region, double spacing,
                                    std::span<const Vec3d> sites, const MedialGoal& goal) {
  AdaptiveSampling sampling(solid, region, spacing);
  sampling.run(sites, goal);
  return sampling.result(goal);
}

}  // namespace cairn::builder
