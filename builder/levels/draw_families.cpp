// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_families.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "levels/group_parts.h"
#include "levels/share_parts.h"
#include "surface/random_stream.h"

namespace cairn::builder {

namespace {

/// Sizes of the flat covers, as fractions of a full lower level. Fewer balls are easier to group. Families are filled
/// up afterwards, which lowers their stand-off by about this power of the fraction.
constexpr std::array kFlatShares{0.625, 0.75, 0.8125, 0.875};
constexpr double kFilling = 0.25;
/// Points of a flat cover.
constexpr std::size_t kFlatPoints = 2000;

class Drawing {
 public:
  Drawing(const TwoLevelProblem& problem, const UpperCovers& uppers, const DepthField& lower)
      : problem_(problem),
        uppers_(uppers),
        lower_(lower),
        few_(evenSample(problem.points, kFlatPoints, 0)),
        allOfFew_(reachOfAll(few_.size())),
        all_(reachOfAll(uppers.points.size())) {}

  DrawnFamilies draw(std::uint64_t k) const {
    const double share = kFlatShares[k % kFlatShares.size()];
    const auto full = static_cast<double>(problem_.branching * problem_.branching);
    LevelProblem flat{few_, lower_, allOfFew_, static_cast<std::size_t>(std::lround(share * full)),
                      problem_.negligible};
    flat.keepGoing = problem_.keepGoing;
    const std::vector<ChildBall> balls = optimiseLevel(flat, {firstBall({problem_.seed, k})});
    // The result of a cancelled search is not used, and families of an incomplete cover take longest.
    if (problem_.keepGoing != nullptr && !(*problem_.keepGoing)())
      return {uppers_.covers[0], balls, std::numeric_limits<double>::infinity()};
    DrawnFamilies drawn = families(balls);
    drawn.promise = standOffOf({balls, 0}, uppers_.points, all_) * std::pow(share, kFilling);
    return drawn;
  }

 private:
  ChildBall firstBall(RandomStream random) const {
    const PointSet& points = uppers_.points;
    const Vec3d center = points[static_cast<std::size_t>(random.uniform() * static_cast<double>(points.size()))];
    return {{center, 0, lower_.depth(center)}, 0};
  }

  /// Groups the flat cover's balls into families below an upper level that is as tight as the search finds. A ball that
  /// two parents hold together becomes two.
  DrawnFamilies families(const std::vector<ChildBall>& flat) const {
    const std::vector<PointSet> parts = partsOf(flat);
    const double tightest = uppers_.covers[0].limit;
    SphereSet start = ballsOf(uppers_.covers[0].balls);
    for (std::size_t i = 0; start.size() < problem_.branching; ++i) start.push_back(start[i]);
    start = groupParts(parts, *uppers_.field, std::move(start), problem_.branching, problem_.seed);
    SharedParts shared =
        shareParts(parts, *uppers_.field, std::move(start), tightest, problem_.branching, problem_.seed);
    CoverLevel upper{levelOf(shared.parents, 0), shared.limit};
    upper.limit = std::max(upper.limit, standOffOf(upper, uppers_.points, all_));
    std::vector<ChildBall> children;
    for (std::size_t i = 0; i < flat.size(); ++i)
      for (const std::uint32_t parent : shared.parentsOf[i]) children.push_back({flat[i].ball, parent});
    return {std::move(upper), std::move(children), 0};
  }

  /// By ball of a flat cover: the points that it holds most cheaply.
  std::vector<PointSet> partsOf(const std::vector<ChildBall>& flat) const {
    std::vector<PointSet> parts(flat.size());
    const Reach owned = ownedBy({flat, 0}, uppers_.points, all_);
    for (std::size_t i = 0; i < owned.size(); ++i)
      for (const std::uint32_t p : owned[i]) parts[i].push(uppers_.points[p]);
    return parts;
  }

  const TwoLevelProblem& problem_;
  const UpperCovers& uppers_;
  const DepthField& lower_;
  PointSet few_;
  Reach allOfFew_, all_;
};

}  // namespace

std::vector<DrawnFamilies> drawFamilies(const TwoLevelProblem& problem, const UpperCovers& uppers,
                                        const DepthField& lower, std::size_t draws) {
  const Drawing drawing(problem, uppers, lower);
  std::vector<DrawnFamilies> drawn(draws);
  tbb::parallel_for(std::size_t{0}, draws, [&](std::size_t k) { drawn[k] = drawing.draw(k); });
  return drawn;
}

}  // namespace cairn::builder
