// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/medial_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "balls/farthest_sample.h"
#include "balls/piece.h"
#include "cairn/builder/import.h"
#include "medial/hubbard_medial.h"
#include "medial/medial_spheres.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

namespace {

/// Number of evenly spread samples from which an adaptive diagram starts.
constexpr std::uint32_t kInitialSites = 60;

Status checkRange(const char* option, std::uint64_t value, std::uint64_t least, std::uint64_t most) {
  if (value >= least && value <= most) return {};
  return Error{"the option " + std::string(option) + " of a medial axis is " + std::to_string(value) + "; choose " +
               std::to_string(least) + " to " + std::to_string(most)};
}

double longestEdgeOf(const Pieces& pieces) {
  double longestSq = 0;
  for (const Piece& piece : pieces) longestSq = std::max(longestSq, longestEdgeSq(piece));
  return std::sqrt(longestSq);
}

void sampleRegularly(MedialAxis& axis, const SignedDistance& solid, const MedialAxisOptions& options,
                     const KeepGoing& keepGoing) {
  const HubbardMedial medial = hubbardMedialOf(solid, options.samples, options.seed, keepGoing);
  for (const ClusterSample& sample : medial.samples) axis.samples.push_back(sample.point);
  for (const HubbardMedial::Sphere& sphere : medial.spheres) axis.inside.push_back(sphere.ball);
}

void sampleAdaptively(MedialAxis& axis, const SignedDistance& solid, double spacing, const MedialAxisOptions& options) {
  const std::vector<Vec3d> sites =
      farthestPointSample(axis.surface, std::min(kInitialSites, options.samples), options.seed % axis.surface.size());
  MedialGoal goal;
  goal.minSpheres = options.spheres;
  goal.maxStandOff = options.spheres == 0 ? 0 : std::numeric_limits<double>::infinity();
  goal.maxInsertions = options.samples - sites.size();
  goal.improveCoverage = true;
  MedialSpheres medial = approximateMedialAxis(solid, PointSet(axis.surface), spacing, sites, goal);
  axis.samples = std::move(medial.sites);
  axis.inside = std::move(medial.inside);
  axis.coverage = std::move(medial.coverage);
}

}  // namespace

std::vector<Ball> MedialAxis::balls() const {
  std::vector<Ball> all = inside;
  all.insert(all.end(), coverage.begin(), coverage.end());
  return all;
}

Result<MedialAxis> medialAxis(const TriangleMesh& mesh, const MedialAxisOptions& options,
                              const ProgressCallback& progress) {
  if (Status s = checkRange("samples", options.samples, 8, 100'000); !s) return s.error();
  if (Status s = checkRange("surfacePieces", options.surfacePieces, 100, 1'000'000); !s) return s.error();
  if (Status s = checkMesh(mesh); !s) return s.error();
  const KeepGoing keepGoing = [&] { return !progress || progress("sampling the medial axis", 0); };
  if (!keepGoing()) return Error{std::string(kCancelled)};
  const SignedDistance solid(mesh);
  Pieces pieces = piecesOf(mesh);
  refinePieces(pieces, options.surfacePieces);
  MedialAxis axis;
  axis.surface = cornersOf(pieces);
  if (options.sampling == MedialSampling::regular)
    sampleRegularly(axis, solid, options, keepGoing);
  else
    sampleAdaptively(axis, solid, longestEdgeOf(pieces), options);
  if (!keepGoing()) return Error{std::string(kCancelled)};
  return axis;
}

}  // namespace cairn::builder
