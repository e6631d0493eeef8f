// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/flat_starts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "balls/ball_fit.h"
#include "cairn/builder/build.h"
#include "cairn/builder/medial_axis.h"
#include "spheres/expand.h"
#include "spheres/merge.h"
#include "surface/random_stream.h"

namespace cairn::builder {
namespace {

/// Points the starts see for each ball, at least and at most.
constexpr std::size_t kSeenPerBall = 20, kMinSeen = 1000, kMaxSeen = 5000;
/// Sets grown from a random first ball, and of random balls alone.
constexpr std::size_t kGrown = 4, kRandom = 3;
/// Medial balls the reductions start from: more for each ball asked for, at most.
constexpr std::size_t kMedialPerBall = 8, kMinMedial = 400, kMaxMedial = 2000;
/// Levels below the root a tree may be grown to for a start: it has 8^levels balls, and takes longer than the search
/// for more.
constexpr std::uint32_t kMaxTreeDepth = 3;

class Starts {
 public:
  Starts(const FlatProblem& problem, const FlatPoints& points)
      : problem_(problem),
        plain_(problem.solid),
        few_(evenSample(points.points, std::clamp(kSeenPerBall * problem.count, kMinSeen, kMaxSeen), 0)) {}

  std::vector<SphereSet> run() {
    std::vector<std::function<SphereSet()>> ways{[this] { return SphereSet{fitBall(few_[0], few_, plain_)}; }};
    for (std::size_t k = 0; k < kGrown; ++k) ways.push_back([this, k] { return randomBalls(1, k); });
    if (!problem_.quick) {
      for (std::size_t k = 0; k < kRandom; ++k)
        ways.push_back([this, k] { return randomBalls(problem_.count, kGrown + k); });
      makeMedial();
      if (!medial_.empty()) {
        ways.push_back([this] { return merge({few_, plain_, problem_.count}, medial_); });
        ways.push_back([this] {
          return expand({few_, plain_, problem_.count}, medial_, ExpandRank::maxElim, kLimits);
        });
      }
      ways.push_back([this] { return levelOfTree(); });
    }
    std::vector<SphereSet> starts(ways.size());
    tbb::parallel_for(std::size_t{0}, ways.size(), [&](std::size_t i) {
      if (problem_.keepGoing()) starts[i] = ways[i]();
    });
    std::erase_if(starts, [](const SphereSet& start) { return start.empty(); });
    return problem_.keepGoing() ? starts : std::vector<SphereSet>();
  }

 private:
  static constexpr ExpandLimits kLimits{.candidates = 2000, .points = 4000, .bisections = 16};

  SphereSet randomBalls(std::size_t count, std::uint64_t stream) const {
    RandomStream random(problem_.seed, stream);
    SphereSet balls;
    while (balls.size() < count) {
      const Vec3d c = few_[static_cast<std::size_t>(random.uniform() * static_cast<double>(few_.size()))];
      balls.push_back({c, 0, plain_.depth(c)});
    }
    return balls;
  }

  void makeMedial() {
    MedialAxisOptions options;
    options.samples = static_cast<std::uint32_t>(std::clamp(kMedialPerBall * problem_.count, kMinMedial, kMaxMedial));
    options.surfacePieces = static_cast<std::uint32_t>(2 * few_.size());
    options.seed = problem_.seed;
    const auto axis =
        medialAxis(problem_.solid.mesh(), options, [this](std::string_view, double) { return problem_.keepGoing(); });
    if (axis) medial_ = axis.value().balls();
  }

  /// The balls of the level of a tree with about as many balls; those that hold least are left out when they are more.
  SphereSet levelOfTree() const {
    BuildOptions options;
    options.depth = 1;
    while (std::pow(options.branching, options.depth) < 0.9 * static_cast<double>(problem_.count) &&
           options.depth < kMaxTreeDepth)
      ++options.depth;
    options.seed = problem_.seed;
    const auto tree =
        buildTree(problem_.solid.mesh(), options, [this](std::string_view, double) { return problem_.keepGoing(); });
    if (!tree) return {};
    SphereSet balls;
    for (const NodeId node : tree.value().levelCut(options.depth)) {
      const Sphere s = tree.value().sphere(node);
      const Vec3d center = tree.value().origin() + Vec3d(s.center);
      balls.push_back({center, s.radius, plain_.depth(center)});
    }
    std::stable_sort(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
    balls.resize(std::min(balls.size(), problem_.count));
    return balls;
  }

  const FlatProblem& problem_;
  SolidDepth plain_;
  PointSet few_;
  std::vector<Ball> medial_;
};

}  // namespace

std::vector<SphereSet> flatStarts(const FlatProblem& problem, const FlatPoints& points) {
  return Starts(problem, points).run();
}

}  // namespace cairn::builder
