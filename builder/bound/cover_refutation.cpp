// SPDX-License-Identifier: GPL-3.0-or-later
#include "bound/cover_refutation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "bound/outside_points.h"
#include "bound/packing_program.h"
#include "certify/protrusion.h"

namespace cairn::builder {
namespace {

using Points = std::vector<std::uint32_t>;
using Weights = std::vector<std::uint64_t>;

/// Weights are fractions of this number. The sum of 20000 of them, times any sensible number of spheres, fits 64 bits.
constexpr double kUnitWeight = 0x1p32;
/// Number of balls and cells that a round adds; twice the number of spheres is added to it.
constexpr std::size_t kMaxLessons = 100;

std::uint64_t loadOf(const Points& points, const Weights& weights) {
  std::uint64_t load = 0;
  for (const std::uint32_t p : points) load += weights[p];
  return load;
}

double surfaceArea(const TriangleMesh& mesh) {
  double area = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = mesh.corners(t);
    area += 0.5 * length(cross(c[1] - c[0], c[2] - c[0]));
  }
  return area;
}

double largestCoordinate(const Vec3d& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Spacing of the first outside points. A ball of radius r can pass between two of them beyond the offset surface by
/// about spacing^2 / (4 r). This should stay below a fortieth of the error. The offset surface is as large as the
/// solid's. Around a solid that is small against the error it is as large as a sphere's.
double outsideSpacing(const SignedDistance& solid, std::uint32_t spheres, double error, double maxOutside) {
  const double area = surfaceArea(solid.mesh());
  const double ball = std::sqrt(area / (4 * spheres));
  const double offsetArea = std::max(area, 4 * std::numbers::pi * error * error);
  return std::max(std::sqrt(0.1 * ball * error), std::sqrt(offsetArea / maxOutside));
}

CenterSearch searchAround(const SignedDistance& solid, std::vector<Vec3d> points, std::vector<Vec3d> outside,
                          double error, const KeepGoing& keepGoing) {
  const Vec3d origin = solid.bounds().center();
  // A ball's centre is one of its points, so it is at most `error` from the solid. The same length again makes room for
  // outside points found later.
  double half = largestCoordinate(solid.bounds().upper - origin) + 2 * error;
  for (Vec3d& p : points) p -= origin;
  for (Vec3d& q : outside) {
    q -= origin;
    half = std::max(half, largestCoordinate(q));
  }
  const double extent = std::max(largestCoordinate(solid.bounds().lower), largestCoordinate(solid.bounds().upper));
  // A surface point and its move to the origin round by less than this.
  const double displacement = 128 * 0x1p-53 * (extent + 2 * half);
  return {std::move(points), std::move(outside), half * (1 + 1e-9), displacement, keepGoing};
}

/// The attempt for one error and one number of spheres. A ball that prevents a proof is tested again. If it protrudes
/// too far, because it slipped between the outside points, its farthest point becomes one of them.
class Attempt {
 public:
  Attempt(const SignedDistance& solid, const std::vector<Vec3d>& points, std::uint32_t spheres, double error,
          double maxOutside, const KeepGoing& keepGoing)
      : solid_(solid),
        keepGoing_(keepGoing),
        origin_(solid.bounds().center()),
        spheres_(spheres),
        error_(error),
        search_(searchAround(solid, points,
                             outsidePoints(solid, error, outsideSpacing(solid, spheres, error, maxOutside), keepGoing),
                             error, keepGoing)),
        program_(points.size()) {}

  /// Adds the balls that prevented a proof at another error.
  void remember(const std::vector<Vec3d>& centers) {
    std::vector<HeavyCell> balls;
    for (const Vec3d& center : centers) balls.push_back({{center, 0}, 0});
    std::vector<Vec3d> again;
    learnFrom(balls, 0, Weights(search_.points().size(), 1), again);
  }

  enum class Outcome { proved, hopeless, open, stopped };
  /// Solves for weights and searches for balls that hold too much of them. `centers` receives the balls that the next
  /// round uses.
  Outcome round(Refutation& proof, std::vector<Vec3d>& centers) {
    const std::vector<double> shares = program_.solve(keepGoing_);
    // The program has only some balls as rows. With all of them its value would be smaller.
    if (std::accumulate(shares.begin(), shares.end(), 0.0) <= spheres_) return Outcome::hopeless;
    proof.weights.clear();
    for (const double share : shares) proof.weights.push_back(static_cast<std::uint64_t>(share * kUnitWeight));
    const std::uint64_t total = std::accumulate(proof.weights.begin(), proof.weights.end(), std::uint64_t{0});
    proof.mostInOneBall = (total - 1) / spheres_;
    const std::optional<std::vector<HeavyCell>> heavy =
        search_.heavierThan(proof.weights, proof.mostInOneBall, finestCell(), keepGoing_);
    if (!heavy) return Outcome::stopped;
    if (heavy->empty()) return Outcome::proved;
    const bool learned = learnFrom(heaviest(*heavy), proof.mostInOneBall, proof.weights, centers);
    return learned ? Outcome::open : Outcome::hopeless;
  }

 private:
  /// Relative to the error, because a cell's slack grows with its size. It is coarser where fractional covers are weak.
  double finestCell() const { return error_ / (spheres_ <= kFewSpheres ? 100 : 24); }

  std::vector<HeavyCell> heaviest(std::vector<HeavyCell> heavy) const {
    std::stable_sort(heavy.begin(), heavy.end(), [](const auto& a, const auto& b) { return a.load > b.load; });
    heavy.resize(std::min<std::size_t>(heavy.size(), kMaxLessons + 2 * spheres_));
    return heavy;
  }

  /// Returns a point of the ball around `center` that holds `held`, if that ball protrudes too far.
  std::optional<Vec3d> beyond(const Vec3d& center, const Points& held) const {
    double radius = 0;
    for (const std::uint32_t p : held) radius = std::max(radius, distance(center, search_.points()[p]));
    const ProtrusionTolerance coarse{0.02, 0.01 * error_, 300};
    const CertifiedProtrusion protrusion = certifiedProtrusion(solid_, origin_ + center, radius, coarse);
    if (protrusion.lower <= error_) return {};
    return protrusion.witness - origin_;
  }

  /// Searches cells whose balls may hold too much for missed outside points. The search covers the ball around the
  /// cell's centre and the larger ball to which that centre grows. Cells that still hold too much become rows.
  bool learnFrom(const std::vector<HeavyCell>& heavy, std::uint64_t most, const Weights& weights,
                 std::vector<Vec3d>& centers) {
    std::vector<std::array<std::optional<Vec3d>, 2>> missed(heavy.size());
    std::vector<Vec3d> grown(heavy.size());
    tbb::parallel_for(std::size_t{0}, heavy.size(), [&](std::size_t i) {
      if (!keepGoing_()) return;
      const CenterCell& cell = heavy[i].cell;
      missed[i][0] = beyond(cell.center, search_.pointsOf(cell));
      grown[i] = cell.half > 0 ? cell.center : search_.grown(cell.center);
      if (cell.half == 0) missed[i][1] = beyond(grown[i], search_.pointsOf({grown[i], 0}));
    });
    if (!keepGoing_()) return false;
    bool learned = false;
    for (const auto& points : missed) {
      for (const std::optional<Vec3d>& q : points) learned = (q && search_.addOutside(*q)) || learned;
    }
    std::vector<Points> rows(heavy.size());
    tbb::parallel_for(std::size_t{0}, heavy.size(), [&](std::size_t i) {
      const bool larger = heavy[i].cell.half == 0 && !missed[i][1];
      Points row = search_.pointsOf(larger ? CenterCell{grown[i], 0} : heavy[i].cell);
      if (loadOf(row, weights) > most) rows[i] = std::move(row);
    });
    for (std::size_t i = 0; i < heavy.size(); ++i) {
      if (!addRow(rows[i])) continue;
      if (heavy[i].cell.half == 0) centers.push_back(missed[i][1] ? heavy[i].cell.center : grown[i]);
      learned = true;
    }
    return learned;
  }

  bool addRow(const Points& row) {
    if (row.size() < 2 || !known_.insert(row).second) return false;
    program_.addRow(row);
    return true;
  }

  const SignedDistance& solid_;
  const KeepGoing& keepGoing_;
  Vec3d origin_;
  std::uint32_t spheres_;
  double error_;
  CenterSearch search_;
  PackingProgram program_;
  std::set<Points> known_;
};

}  // namespace

std::optional<Refutation> CoverRefuter::refute(const std::vector<Vec3d>& points, std::uint32_t spheres, double error,
                                               const RefutationEffort& effort) {
  Attempt attempt(solid_, points, spheres, error, effort.maxOutside, keepGoing_);
  attempt.remember(centers_);
  Refutation proof;
  for (int round = 0; round < effort.maxRounds && keepGoing_(); ++round) {
    switch (attempt.round(proof, centers_)) {
      case Attempt::Outcome::proved:
        return proof;
      case Attempt::Outcome::hopeless:
      case Attempt::Outcome::stopped:
        return {};
      case Attempt::Outcome::open:
        break;
    }
  }
  return {};
}

}  // namespace cairn::builder
