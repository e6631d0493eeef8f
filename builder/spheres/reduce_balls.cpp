// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/reduce_balls.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <string>

#include "balls/piece.h"
#include "cover/grow_to_cover.h"
#include "medial/hubbard_medial.h"
#include "spheres/burst.h"
#include "spheres/expand.h"
#include "spheres/hubbard.h"
#include "spheres/merge.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

namespace {

/// Where balls meet, pieces are cut down to this fraction of the longest edge of all.
constexpr double kFinestSeam = 0.1;
/// Hundreds of balls have some hundredths of one ball's stand-off; this precision suffices for them.
constexpr ExpandLimits kUnlimited{.candidates = ~std::size_t{0}, .points = ~std::size_t{0}, .bisections = 20};

SphereSet byHubbard(const MedialAxis& axis, const SignedDistance& solid, std::size_t count,
                    const KeepGoing& keepGoing) {
  const HubbardMedial medial = hubbardMedialFrom(solid, axis.samples);
  std::vector<std::uint32_t> members(medial.spheres.size());
  std::iota(members.begin(), members.end(), 0U);
  SphereSet set;
  for (const HubbardGroup& group : mergeHubbard(medial, members, count, SolidDepth(solid), keepGoing))
    set.push_back(group.ball);
  return set;
}

SphereSet reduced(const MedialAxis& axis, const SignedDistance& solid, const ReduceOptions& options,
                  const KeepGoing& keepGoing) {
  const PointSet points(axis.surface);
  const SolidDepth depth(solid);
  const CoverProblem problem{points, depth, options.count};
  const std::vector<Ball> candidates = axis.balls();
  switch (options.reduction) {
    case Reduction::hubbard:
      return byHubbard(axis, solid, options.count, keepGoing);
    case Reduction::merge:
      return merge(problem, candidates);
    case Reduction::burst:
      return burst(problem, candidates);
    case Reduction::expand:
      return expand(problem, candidates, ExpandRank::maxElim, kUnlimited);
    case Reduction::expandCover:
      return expand(problem, candidates, ExpandRank::maxCover, kUnlimited);
  }
  return {};
}

Status checkOptions(const ReduceOptions& options) {
  if (options.count < 1) return Error{"a set of 0 balls covers nothing; choose 1 or more"};
  if (options.surfacePieces < 100 || options.surfacePieces > 1'000'000)
    return Error{"the option surfacePieces of a reduction is " + std::to_string(options.surfacePieces) +
                 "; choose 100 to 1000000"};
  return {};
}

}  // namespace

Result<std::vector<Ball>> reduceBalls(const TriangleMesh& mesh, const MedialAxis& axis, const ReduceOptions& options,
                                      const KeepGoing& keepGoing) {
  assert(!axis.inside.empty());
  if (Status s = checkOptions(options); !s) return s.error();
  const SignedDistance solid(mesh);
  SphereSet set = reduced(axis, solid, options, keepGoing);
  if (set.empty() || !keepGoing()) return Error{std::string(kCancelled)};
  Pieces pieces = piecesOf(mesh);
  refinePieces(pieces, options.surfacePieces);
  double longestSq = 0;
  for (const Piece& piece : pieces) longestSq = std::max(longestSq, longestEdgeSq(piece));
  growToCover(set, std::move(pieces), kFinestSeam * std::sqrt(longestSq));
  return set;
}

}  // namespace cairn::builder
