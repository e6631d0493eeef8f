// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "volumes/pair_traversal.h"
#include "volumes/solids.h"
#include "volumes/volume_tree.h"

namespace cairn::bench {

struct MeasureOptions {
  std::size_t poses = 200, runs = 5;
  double runMs = 20;                                     ///< least length of a timed run
  std::vector<double> errorPercents{5, 2, 1, 0.5, 0.2};  ///< of the mesh's diagonal
  std::vector<double> costs{10, 30, 100, 300, 1000};     ///< at which traversals are interrupted, tests of two balls
  std::uint64_t seed = 1;
};

/// What one set of kinds needs down to one error.
struct AtError {
  double errorPercent = 0;
  bool isReached = true;                          ///< false where the tree ended before
  std::array<std::size_t, kVolumeKinds> nodes{};  ///< volumes at which traversals end, by kind
  std::size_t bytes = 0;                          ///< of those
  double operations = 0, tests = 0, pairs = 0;    ///< of one traversal of two bodies that touch: mean of all poses
  double microseconds = 0;                        ///< CPU time of one: mean of all poses, median of runs

  std::size_t allNodes() const { return nodes[0] + nodes[1] + nodes[2] + nodes[3]; }
  /// Pair tests of all nodes, in tests of two balls.
  double cost() const {
    double sum = 0;
    for (std::size_t k = 0; k < kVolumeKinds; ++k) sum += static_cast<double>(nodes[k]) * kPairCost[k];
    return sum;
  }
};

/// Whether a builder should keep the mixed volumes of a body: only where they cost less than its spheres. Counted, not
/// timed, so that it is the same everywhere.
inline bool isWorthKeeping(const AtError& mixed, const AtError& spheres) {
  return mixed.cost() < spheres.cost();
}

/// One mesh: the same errors, the same poses, for each set. `interrupted` is the certified error of pairs (both nodes'
/// together, the worst of each traversal, mean of all poses) at a cost, in per cent of the diagonal.
struct Comparison {
  std::string name;
  std::size_t triangles = 0;
  std::vector<double> growSeconds;               ///< by set
  std::vector<std::vector<double>> interrupted;  ///< by set, then by cost
  std::vector<std::vector<AtError>> sets;        ///< by set, then by error
};

/// Parts of the surface that the first set's tree ends at, and how each kind of volume stands around the same parts.
struct SameParts {
  double errorPercent = 0;
  std::size_t parts = 0;
  std::array<double, kVolumeKinds> worst{}, mean{};  ///< certified error, per cent of the diagonal
  std::array<std::size_t, kVolumeKinds> chosen{};    ///< parts for which it is the best at equal cost
};

/// Grows a tree of each set and traverses two bodies in poses in which they touch.
Comparison compareSets(const NamedMesh& named, const std::vector<KindSet>& sets, const MeasureOptions& options);

/// Fits every kind to the parts of the spheres' own tree at these errors, as far as it has no more than `mostParts`.
std::vector<SameParts> compareOnSameParts(const NamedMesh& named, const std::vector<double>& errorPercents,
                                          std::size_t mostParts);

/// Nanoseconds of moving one volume and testing it against another: by the two kinds, median of runs. The first number
/// is that of plain balls, without a look at the kind.
struct PairCosts {
  double plainBalls = 0;
  std::array<std::array<double, kVolumeKinds>, kVolumeKinds> ofKinds{};
};
PairCosts measurePairCosts(const MeasureOptions& options);

}  // namespace cairn::bench
