// SPDX-License-Identifier: GPL-3.0-or-later
#include "split_region.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "balls/ball_fit.h"
#include "balls/depth_field.h"
#include "balls/enclosing_ball.h"
#include "balls/farthest_sample.h"
#include "cover/divide.h"
#include "cover/divide_by_planes.h"
#include "cover/optimise.h"
#include "regions/method_traits.h"
#include "regions/reduce.h"
#include "spheres/hubbard.h"
#include "spheres/solid_octants.h"
#include "surface/infinity.h"

namespace cairn::builder {

namespace {

/// Number of pieces a region is cut into before spheres are fitted.
constexpr std::size_t kMinPieces = 400;
/// Number of points that sphere sets are fitted to. More would only cost time, because the division sees every piece.
constexpr std::size_t kMaxPoints = 1500;
/// Seams are cut down to this fraction of the longest edge of the region's pieces.
constexpr double kFinestSeam = 0.1;
/// Lower limit, as a fraction of the stand-off. The rest of a seam costs its width times the sine of the angle between
/// the balls and the surface, a few percent.
constexpr double kFinestSeamOfStandOff = 0.2;
/// Factor on the points' stand-off up to which a piece is not bisected.
constexpr double kSeamAllowance = 1.01;
/// A corner that needs more than this factor of the stand-off joins the points. The second number limits these rounds.
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

double finestSeam(const Split& split) {
  return std::max(kFinestSeam * spacingOf(split.pieces), kFinestSeamOfStandOff * split.standOff);
}

/// Parts of the division without pieces, and their balls, are dropped.
void dropEmpty(Split& split, std::vector<Pieces>& parts) {
  std::size_t place = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) continue;
    split.balls[place] = split.balls[i];
    split.bias[place] = split.bias[i];
    if (place < i) parts[place] = std::move(parts[i]);
    ++place;
  }
  split.balls.resize(place);
  split.bias.resize(place);
  parts.resize(place);
}

/// The most likely to have a large error first.
std::vector<std::size_t> worstFirst(const SphereSet& balls) {
  std::vector<std::size_t> order(balls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return balls[a].standOff() > balls[b].standOff(); });
  return order;
}

std::vector<Pieces> dividedBy(const Split& split, SurfaceDivision division, double finest) {
  if (division == SurfaceDivision::planes) return divideByPlanes(split.pieces, split.balls, finest);
  return divide(split.pieces, split.balls, split.bias, split.standOff, finest);
}

/// Fills in the children from the pieces, the balls and the bias; balls without a piece are dropped. A part that equals
/// the part of `previous` at the same index keeps its child. False when a child's error is above `ofInterest`; the
/// children are then incomplete.
bool makeChildren(Split& split, const Split* previous, const SignedDistance& solid, const SplitSettings& settings,
                  double ofInterest) {
  const Refit refit = traitsOf(settings.method).refit;
  std::vector<Pieces> parts = dividedBy(split, settings.division, finestSeam(split));
  dropEmpty(split, parts);
  split.children.resize(parts.size());
  for (const std::size_t i : worstFirst(split.balls)) {
    if (previous != nullptr && i < previous->children.size() && previous->children[i].pieces == parts[i])
      split.children[i] = previous->children[i];
    else
      split.children[i] = fittedRegion(split.balls[i], std::move(parts[i]), solid, refit, ofInterest);
    if (split.children[i].error > ofInterest) return false;
  }
  return true;
}

/// The worst covered corners of pieces, which the fitted points may have missed.
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

void take(Split& split, SphereSet balls, double negligible) {
  split.balls = std::move(balls);
  split.bias.assign(split.balls.size(), 0);
  split.standOff = kSeamAllowance * std::max(coverStandOff(split.points, split.balls), negligible);
}

/// Divides the region among the balls as they are.
void settle(Split& split, SphereSet balls, const SignedDistance& solid, const SplitSettings& settings) {
  take(split, std::move(balls), settings.negligible);
  makeChildren(split, nullptr, solid, settings, kInfinity);
}

/// Divides the region among the balls. The seams show the cost of the surface between the pieces' corners. The balls
/// are optimised for the worst of these points too, then the pieces are divided finally. False as with `makeChildren`.
bool settleOptimised(Split& split, SphereSet balls, const CoverProblem& problem, const SignedDistance& solid,
                     const SplitSettings& settings, double ofInterest) {
  take(split, std::move(balls), settings.negligible);
  const double finest = finestSeam(split);
  for (int round = 0; round < kSeamRounds; ++round) {
    const std::vector<Vec3d> worst = worstCovered(split, finest);
    for (const Vec3d& corner : farthestPointSample(worst, kMaxSeamPoints, 0)) split.points.push(corner);
    take(split, optimise(problem, split.balls), settings.negligible);
  }
  return makeChildren(split, nullptr, solid, settings, ofInterest);
}

/// Fills in `split`, an empty one. False as with `makeChildren`.
bool splitByBalls(Split& split, const Region& region, const SignedDistance& solid, const SplitSettings& settings,
                  int swapRounds, double ofInterest) {
  split.pieces = region.pieces;
  refinePieces(split.pieces, kMinPieces);
  split.points = pointsOf(split.pieces, settings.seed);
  const SolidDepth depth(solid);
  const CoverProblem problem{split.points, depth, settings.branching};
  SphereSet balls = reduce(problem, region, spacingOf(split.pieces), solid, settings, swapRounds);
  if (settings.optimiser != Optimiser::cairn) {
    settle(split, balls, solid, settings);
    if (split.children.size() >= 2) return true;
    // A set in which one ball takes everything does not divide the region. The optimisation completes the set and
    // spreads it.
    split.children.clear();
    balls = optimise(problem, std::move(balls));
  }
  return settleOptimised(split, std::move(balls), problem, solid, settings, ofInterest);
}

/// Divides a region similar to that of `like`, starting from the balls of `like`.
bool splitLike(Split& split, const Region& region, const Split& like, const SignedDistance& solid,
               const SplitSettings& settings, double ofInterest) {
  split.pieces = region.pieces;
  refinePieces(split.pieces, kMinPieces);
  split.points = pointsOf(split.pieces, settings.seed);
  const SolidDepth depth(solid);
  const CoverProblem problem{split.points, depth, settings.branching};
  return settleOptimised(split, optimise(problem, seenBy(depth, like.balls)), problem, solid, settings, ofInterest);
}

/// Hubbard's groups of medial spheres, each with the surface nearest to its spheres (4.3). None when the region has
/// fewer than two spheres: Hubbard's trees end where the medial spheres do.
std::vector<Region> splitByGroups(const Region& region, const SignedDistance& solid, const SplitSettings& settings) {
  std::vector<Region> children;
  if (region.medial.size() < 2) return children;
  const SolidDepth depth(solid);
  std::vector<HubbardGroup> groups =
      mergeHubbard(*settings.hubbard, region.medial, settings.branching, depth, settings.keepGoing);
  if (groups.empty()) return children;
  Pieces pieces = region.pieces;
  refinePieces(pieces, kMinPieces);
  std::vector<Pieces> parts = divideByOwners(*settings.hubbard, groups, pieces);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (parts[i].empty()) continue;
    children.push_back(fittedRegion(groups[i].ball, std::move(parts[i]), solid, Refit::none));
    children.back().medial = std::move(groups[i].members);
  }
  return children;
}

Region cubeRegion(const Cube& cube, Pieces pieces, const SignedDistance& solid, bool filled) {
  std::vector<Vec3d> held = cornersOf(pieces);
  for (unsigned i = 0; filled && i < 8; ++i) held.push_back(cornerOf(cube, i));
  const Ball ball = ballAround(cube.center, PointSet(held), SolidDepth(solid));
  return {ball, errorOf(ball, solid), std::move(pieces), cube, filled};
}

std::vector<Region> splitByCubes(const Region& region, const SignedDistance& solid, const SplitSettings& settings) {
  std::vector<Region> children;
  const double finest = std::max(settings.negligible, 0.05 * region.ball.radius);
  const bool filled = settings.method == Method::solidOctree;
  SolidOctants parts;
  if (filled)
    parts = divideSolid(region.pieces, region.cube, finest, solid);
  else
    parts.surface = divideByOctants(region.pieces, region.cube, finest);
  for (Octant& octant : parts.surface)
    children.push_back(cubeRegion(octant.cube, std::move(octant.pieces), solid, filled));
  for (const Cube& cube : parts.inside) children.push_back(cubeRegion(cube, {}, solid, filled));
  return children;
}

bool isPointless(const Region& region, const SplitSettings& settings) {
  return region.pieces.empty() || region.ball.standOff() <= settings.negligible;
}

/// Returns the closing of the solid that balls of about this stand-off may fill in the region; null when it cannot be
/// distinguished from all of space.
std::unique_ptr<DepthField> closingAround(const Region& region, const SignedDistance& solid,
                                          const SplitSettings& settings, const SphereSet& balls, double standOff) {
  if (settings.convex) return std::make_unique<SolidDepth>(solid);
  auto closed = std::make_unique<ClosedDepth>(solid, kClosingScale * standOff, closingSpacing(balls, standOff),
                                              region.ball.center, region.ball.radius + 2 * standOff);
  if (!closed->usable()) return nullptr;
  return closed;
}

/// Applies `refineSplit` to a division, whose children may be missing, and returns it when its worst error is below
/// `goal`.
std::optional<Split> refinedBelow(const Split& split, const Region& region, const SignedDistance& solid,
                                  const SplitSettings& settings, int swapRounds, double goal) {
  const double standOff = coverStandOff(split.points, split.balls);
  if (standOff <= settings.negligible) return std::nullopt;
  const std::unique_ptr<DepthField> depth = closingAround(region, solid, settings, split.balls, standOff);
  if (!depth) return std::nullopt;
  const CoverProblem problem{split.points, *depth, settings.branching};
  SphereSet balls = optimiseBySwaps(problem, seenBy(*depth, split.balls), swapRounds);
  Split refined;
  refined.pieces = split.pieces;
  refined.points = split.points;
  const CoverProblem withSeams{refined.points, *depth, settings.branching};
  if (!settleOptimised(refined, std::move(balls), withSeams, solid, settings, goal)) return std::nullopt;
  if (refined.worst() >= goal) return std::nullopt;
  return refined;
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
  if (isPointless(region, settings)) return {};
  Split split;
  if (traitsOf(settings.method).division == Division::cubes)
    split.children = splitByCubes(region, solid, settings);
  else if (traitsOf(settings.method).division == Division::groups)
    split.children = splitByGroups(region, solid, settings);
  else
    splitByBalls(split, region, solid, settings, swapRounds, kInfinity);
  // A solid octree's cube may meet very little surface in one corner. The small octant there replaces a large ball.
  const std::size_t least = settings.method == Method::solidOctree ? 1 : 2;
  if (split.children.size() < least) return {};
  return split;
}

Split refineSplit(const Split& split, const Region& region, const SignedDistance& solid, const SplitSettings& settings,
                  int swapRounds) {
  if (split.children.empty()) return split;
  std::optional<Split> refined = refinedBelow(split, region, solid, settings, swapRounds, split.worst());
  return refined ? *std::move(refined) : split;
}

std::optional<SplitBelow> splitBelow(const Region& region, const Split& like, const SignedDistance& solid,
                                     const SplitSettings& settings, int swapRounds, double goal) {
  assert(settings.optimiser == Optimiser::cairn && goal > settings.negligible);
  SplitBelow found;
  if (isPointless(region, settings)) return found;
  const bool within = like.balls.empty() ? splitByBalls(found.split, region, solid, settings, 0, goal)
                                         : splitLike(found.split, region, like, solid, settings, goal);
  if (found.split.balls.size() < 2) return SplitBelow{};
  if (within && found.split.worst() < goal) return found;
  std::optional<Split> refined = refinedBelow(found.split, region, solid, settings, swapRounds, goal);
  if (!refined) return std::nullopt;
  return SplitBelow{*std::move(refined), true};
}

SphereSet seenBy(const DepthField& field, SphereSet balls) {
  for (Ball& ball : balls) ball.depth = field.depth(ball.center);
  return balls;
}

Split splitAmong(const Split& split, SphereSet start, const DepthField& field, const SignedDistance& solid,
                 const SplitSettings& settings) {
  Split among;
  among.pieces = split.pieces;
  among.points = split.points;
  const CoverProblem problem{among.points, field, settings.branching};
  settleOptimised(among, std::move(start), problem, solid, settings, kInfinity);
  return among;
}

Split splitAsTheyAre(const Split& split, SphereSet balls, const SignedDistance& solid, const SplitSettings& settings) {
  Split among;
  among.pieces = split.pieces;
  among.points = split.points;
  settle(among, std::move(balls), solid, settings);
  return among;
}

std::optional<Split> redivide(const Split& split, std::vector<double> bias, double standOff, double ofInterest,
                              const SignedDistance& solid, const SplitSettings& settings) {
  Split changed{split.pieces, split.points, split.balls, std::move(bias), standOff, {}, split.allowed};
  if (!makeChildren(changed, &split, solid, settings, ofInterest)) return std::nullopt;
  return changed;
}

}  // namespace cairn::builder
