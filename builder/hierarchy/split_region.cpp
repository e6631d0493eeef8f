// SPDX-License-Identifier: GPL-3.0-or-later
#include "split_region.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "medial/medial_spheres.h"
#include "spheres/ball_fit.h"
#include "spheres/depth_field.h"
#include "spheres/divide.h"
#include "spheres/enclosing_ball.h"
#include "spheres/expand.h"
#include "spheres/merge.h"
#include "spheres/optimise.h"

namespace cairn::builder {

namespace {

/// Pieces a region is cut into before spheres are fitted to it.
constexpr std::size_t kMinPieces = 400;
/// Points the sphere sets are fitted to; more only cost time, since the division sees every piece anyway.
constexpr std::size_t kMaxPoints = 1500;
/// Initial sites of a region's Voronoi diagram.
constexpr std::size_t kInitialSites = 60;
/// Points added to it at most: the spheres it starts from are moved freely afterwards, a finer diagram gains nothing.
constexpr std::size_t kMaxInsertions = 100;
/// Seams are cut down to this part of the longest edge of the region's pieces.
constexpr double kFinestSeam = 0.1;
/// And not below this part of the stand-off: what is left of a seam costs its width times the sine of the angle at
/// which the balls leave the surface, a few percent.
constexpr double kFinestSeamOfStandOff = 0.2;
/// Stand-off allowed to a piece before it is bisected, over what the points need.
constexpr double kSeamAllowance = 1.01;
/// A corner that needs more than this part of the stand-off joins the points, and how often they are completed so.
constexpr double kNearlyWorst = 0.97;
constexpr int kSeamRounds = 2;
constexpr std::size_t kMaxSeamPoints = 400;
PointSet pointsOf(const Pieces& pieces, std::uint64_t seed) {
  const std::vector<Vec3d> corners = cornersOf(pieces);
  return PointSet(farthestPointSample(corners, kMaxPoints, seed % corners.size()));
}

double spacingOf(const Pieces& pieces) {
  double longestSq = 0;
  for (const Piece& piece : pieces) longestSq = std::max(longestSq, longestEdgeSq(piece));
  return std::sqrt(longestSq);
}

MedialSpheres medialSpheresOf(const Region& region, const Split& split, const SignedDistance& solid,
                              const SplitSettings& settings) {
  std::vector<Vec3d> list(split.points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = split.points[i];
  const std::vector<Vec3d> sites = farthestPointSample(list, kInitialSites, settings.seed % list.size());
  MedialGoal goal;
  goal.maxStandOff = 0.5 * region.ball.standOff();
  goal.maxOutside = 0.5 * region.ball.standOff();
  goal.maxInsertions = kMaxInsertions;
  return approximateMedialAxis(solid, split.points, spacingOf(split.pieces), sites, goal);
}

SphereSet reduce(const CoverProblem& problem, const MedialSpheres& medial, Method method, int swapRounds) {
  std::vector<Ball> covering = medial.inside;
  covering.insert(covering.end(), medial.coverage.begin(), medial.coverage.end());
  std::vector<Ball> all = medial.inside;
  all.insert(all.end(), medial.outside.begin(), medial.outside.end());
  if (covering.empty()) covering.push_back(fitBall(problem.points[0], problem.points, problem.solid));
  if (all.empty()) all = covering;
  if (method == Method::expand) return optimiseBySwaps(problem, expand(problem, all), swapRounds);
  if (method == Method::merge) return optimiseBySwaps(problem, merge(problem, covering), swapRounds);
  SphereSet expanded = optimise(problem, expand(problem, all));
  SphereSet merged = optimise(problem, merge(problem, covering));
  return optimiseBySwaps(
      problem, coverStandOff(problem.points, merged) < coverStandOff(problem.points, expanded) ? merged : expanded,
      swapRounds);
}

double finestSeam(const Split& split) {
  return std::max(kFinestSeam * spacingOf(split.pieces), kFinestSeamOfStandOff * split.standOff);
}

/// Fills in the children from the pieces, the balls and the bias; balls that get no piece are dropped. A part that
/// `previous` has too, at the same place, keeps its child.
void makeChildren(Split& split, const Split* previous, const SignedDistance& solid) {
  const double finest = finestSeam(split);
  std::vector<Pieces> parts = divide(split.pieces, split.balls, split.bias, split.standOff, finest);
  std::size_t place = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) continue;
    split.balls[place] = split.balls[i];
    split.bias[place] = split.bias[i];
    if (previous != nullptr && place < previous->children.size() && previous->children[place].pieces == parts[i]) {
      split.children.push_back(previous->children[place]);
    } else {
      split.children.push_back(fittedRegion(split.balls[place], std::move(parts[i]), solid));
    }
    ++place;
  }
  split.balls.resize(place);
  split.bias.resize(place);
}

/// Corners of pieces that are covered worst, which the points the balls were fitted to may have missed.
std::vector<Vec3d> worstCovered(const Split& split, double finest) {
  const std::vector<Pieces> parts = divide(split.pieces, split.balls, split.bias, split.standOff, finest);
  Pieces worst;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const Piece& piece : parts[i])
      for (const Vec3d& corner : piece.corners)
        if (costOf(split.balls[i], corner) > kNearlyWorst * split.standOff) {
          worst.push_back(piece);
          break;
        }
  return cornersOf(worst);
}

/// Divides the region among the balls. The seams show what the points between the pieces' corners cost; the balls are
/// optimised for the worst of them as well, then the pieces are divided for good.
void settle(Split& split, SphereSet balls, const CoverProblem& problem, const SignedDistance& solid,
            double negligible) {
  const auto take = [&](SphereSet set) {
    split.balls = std::move(set);
    split.bias.assign(split.balls.size(), 0);
    split.standOff = kSeamAllowance * std::max(coverStandOff(split.points, split.balls), negligible);
  };
  take(std::move(balls));
  const double finest = finestSeam(split);
  for (int round = 0; round < kSeamRounds; ++round) {
    const std::vector<Vec3d> worst = worstCovered(split, finest);
    for (const Vec3d& corner : farthestPointSample(worst, kMaxSeamPoints, 0)) split.points.push(corner);
    take(optimise(problem, split.balls));
  }
  makeChildren(split, nullptr, solid);
}

Split splitByBalls(const Region& region, const SignedDistance& solid, const SplitSettings& settings, int swapRounds) {
  Split split;
  split.pieces = region.pieces;
  refinePieces(split.pieces, kMinPieces);
  split.points = pointsOf(split.pieces, settings.seed);
  const SolidDepth depth(solid);
  const CoverProblem problem{split.points, depth, settings.branching};
  const MedialSpheres medial = medialSpheresOf(region, split, solid, settings);
  settle(split, reduce(problem, medial, settings.method, swapRounds), problem, solid, settings.negligible);
  return split;
}

std::vector<Region> splitByCubes(const Region& region, const SignedDistance& solid, const SplitSettings& settings) {
  std::vector<Region> children;
  const double finest = std::max(settings.negligible, 0.05 * region.ball.radius);
  for (Octant& octant : divideByOctants(region.pieces, region.cube, finest)) {
    const Ball ball = ballAround(octant.cube.center, PointSet(cornersOf(octant.pieces)), SolidDepth(solid));
    children.push_back({ball, errorOf(ball, solid), std::move(octant.pieces), octant.cube});
  }
  return children;
}

}  // namespace

Region rootRegion(const SignedDistance& solid, std::size_t samples) {
  Region root;
  root.pieces = piecesOf(solid.mesh());
  refinePieces(root.pieces, samples);
  const EnclosingBall smallest = smallestEnclosingBall(solid.mesh().vertices);
  root.ball = {smallest.center, smallest.radius, solid.depth(smallest.center)};
  root.error = errorOf(root.ball, solid);
  root.cube = cubeAround(boundsOf(solid.mesh()));
  return root;
}

double Split::worst() const {
  double worst = 0;
  for (const Region& child : children) worst = std::max(worst, child.error);
  return worst;
}

Split splitRegion(const Region& region, const SignedDistance& solid, const SplitSettings& settings, int swapRounds) {
  if (region.ball.standOff() <= settings.negligible) return {};
  Split split;
  if (settings.method == Method::octree)
    split.children = splitByCubes(region, solid, settings);
  else
    split = splitByBalls(region, solid, settings, swapRounds);
  if (split.children.size() < 2) return {};
  return split;
}

Split refineSplit(const Split& split, const Region& region, const SignedDistance& solid, const SplitSettings& settings,
                  int swapRounds) {
  const double standOff = coverStandOff(split.points, split.balls);
  if (split.children.empty() || standOff <= settings.negligible) return split;
  const ClosedDepth depth(solid, kClosingScale * standOff, closingSpacing(split.balls, standOff), region.ball.center,
                          region.ball.radius + 2 * standOff);
  if (!depth.usable()) return split;
  Split refined;
  refined.pieces = split.pieces;
  refined.points = split.points;
  const CoverProblem problem{refined.points, depth, settings.branching};
  SphereSet start = split.balls;
  for (Ball& ball : start) ball.depth = depth.depth(ball.center);
  settle(refined, optimiseBySwaps(problem, std::move(start), swapRounds), problem, solid, settings.negligible);
  return refined.worst() < split.worst() ? refined : split;
}

Split redivide(const Split& split, std::vector<double> bias, double standOff, const SignedDistance& solid) {
  Split changed = split;
  changed.children.clear();
  changed.bias = std::move(bias);
  changed.standOff = standOff;
  makeChildren(changed, &split, solid);
  return changed;
}

}  // namespace cairn::builder
