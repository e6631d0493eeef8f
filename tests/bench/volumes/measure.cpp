// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/measure.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "cpu_seconds.h"
#include "volumes/touching_poses.h"

namespace cairn::bench {
namespace {

using builder::SignedDistance;

// Of the diagonal. Bodies overlap by less, which is far below the least error compared.
constexpr double kTouch = 1e-4;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Two bodies of one mesh in all poses.
struct Scene {
  std::vector<RigidMove> bToA, aToB;
  double lengths = 0;
};

Scene sceneOf(const SignedDistance& solid, const MeasureOptions& options) {
  Scene scene;
  const double size = solid.bounds().diagonal();
  scene.bToA = touchingPoses(solid, options.poses, options.seed, kTouch * size);
  const double reach = size + length(solid.bounds().center());
  for (const RigidMove& move : scene.bToA) {
    scene.aToB.push_back(inverseOf(move));
    scene.lengths = std::max(scene.lengths, 2 * reach + length(move.translation));
  }
  return scene;
}

/// All poses traversed down to one error, as work that can be repeated.
class Traversing {
 public:
  virtual ~Traversing() = default;
  virtual PairWork run(std::size_t pose, double error, double mostCost) = 0;
  virtual std::size_t found() const = 0;
};

template <class Volume>
class TraversingOf final : public Traversing {
 public:
  TraversingOf(TraversedTree<Volume> tree, const Scene& scene) : tree_(std::move(tree)), scene_(scene) {}
  PairWork run(std::size_t pose, double error, double mostCost) override {
    return traversal_.run(tree_, tree_, scene_.bToA[pose], scene_.aToB[pose], error, scene_.lengths, mostCost);
  }
  std::size_t found() const override { return traversal_.found().size(); }

 private:
  TraversedTree<Volume> tree_;
  const Scene& scene_;
  PairTraversal<Volume> traversal_;
};

/// A tree of spheres alone pays for nothing that spheres do not need.
std::unique_ptr<Traversing> traversingOf(const VolumeTree& tree, const KindSet& set, const Scene& scene) {
  if (set.kinds == std::vector{VolumeKind::ball}) {
    TraversedTree<PlainBall> balls;
    for (const VolumeNode& n : tree.nodes) balls.push_back({{n.volume.center, n.volume.radius}, n.error, n.firstChild});
    return std::make_unique<TraversingOf<PlainBall>>(std::move(balls), scene);
  }
  TraversedTree<SweptBall> volumes;
  for (const VolumeNode& n : tree.nodes) volumes.push_back({n.volume, n.error, n.firstChild});
  return std::make_unique<TraversingOf<SweptBall>>(std::move(volumes), scene);
}

void countWork(Traversing& traversing, std::size_t poses, double error, AtError& row) {
  for (std::size_t pose = 0; pose < poses; ++pose) {
    const PairWork work = traversing.run(pose, error, kUnlimited);
    row.tests += static_cast<double>(work.tests);
    row.operations += static_cast<double>(work.operations());
    row.pairs += static_cast<double>(traversing.found());
  }
  for (double* sum : {&row.tests, &row.operations, &row.pairs}) *sum /= static_cast<double>(poses);
}

/// The certified error of traversals cut short, per cent of the size, by cost.
std::vector<double> interruptedErrors(Traversing& traversing, double error, double size,
                                      const MeasureOptions& options) {
  std::vector<double> errors;
  for (const double cost : options.costs) {
    double sum = 0;
    for (std::size_t pose = 0; pose < options.poses; ++pose) sum += traversing.run(pose, error, cost).worstError;
    errors.push_back(100 * sum / size / static_cast<double>(options.poses));
  }
  return errors;
}

void countNodes(const VolumeTree& tree, double error, AtError& row) {
  for (const std::uint32_t node : cutAt(tree, error)) {
    const VolumeNode& n = tree.nodes[node];
    ++row.nodes[static_cast<std::size_t>(n.volume.kind)];
    row.bytes += storedBytes(n.volume.kind);
    row.isReached &= n.error <= error;
  }
}

/// Seconds of one round of all poses, from as many rounds as fill a run.
double timedRound(Traversing& traversing, std::size_t poses, double error, double leastSeconds) {
  std::size_t rounds = 0;
  const double start = cpuSeconds();
  double spent = 0;
  while (rounds == 0 || spent < leastSeconds) {
    for (std::size_t pose = 0; pose < poses; ++pose) (void)traversing.run(pose, error, kUnlimited);
    ++rounds;
    spent = cpuSeconds() - start;
  }
  return spent / static_cast<double>(rounds);
}

/// The sets in turn, run after run, so that what disturbs the machine disturbs all of them.
void timeSets(std::vector<std::unique_ptr<Traversing>>& sets, double error, std::size_t place,
              const MeasureOptions& options, Comparison& out) {
  std::vector<std::vector<double>> seconds(sets.size());
  for (std::size_t run = 0; run < options.runs; ++run)
    for (std::size_t s = 0; s < sets.size(); ++s)
      seconds[s].push_back(timedRound(*sets[s], options.poses, error, 1e-3 * options.runMs));
  for (std::size_t s = 0; s < sets.size(); ++s)
    out.sets[s][place].microseconds = 1e6 * median(seconds[s]) / static_cast<double>(options.poses);
}

}  // namespace

Comparison compareSets(const NamedMesh& named, const std::vector<KindSet>& sets, const MeasureOptions& options) {
  const SignedDistance solid(named.mesh);
  const double size = solid.bounds().diagonal();
  const Scene scene = sceneOf(solid, options);
  Comparison out{named.name, named.mesh.triangles.size(), {}, {}, {}};
  std::vector<std::unique_ptr<Traversing>> traversings;
  const double least = *std::min_element(options.errorPercents.begin(), options.errorPercents.end());
  for (const KindSet& set : sets) {
    const double start = cpuSeconds();
    const VolumeTree tree = growTree(solid, set.kinds, {.error = least / 100 * size});
    out.growSeconds.push_back(cpuSeconds() - start);
    traversings.push_back(traversingOf(tree, set, scene));
    out.interrupted.push_back(interruptedErrors(*traversings.back(), least / 100 * size, size, options));
    out.sets.emplace_back();
    for (const double percent : options.errorPercents) {
      AtError row{.errorPercent = percent};
      countNodes(tree, percent / 100 * size, row);
      countWork(*traversings.back(), options.poses, percent / 100 * size, row);
      out.sets.back().push_back(row);
    }
  }
  for (std::size_t i = 0; i < options.errorPercents.size(); ++i)
    timeSets(traversings, options.errorPercents[i] / 100 * size, i, options, out);
  return out;
}

std::vector<SameParts> compareOnSameParts(const NamedMesh& named, const std::vector<double>& errorPercents,
                                          std::size_t mostParts) {
  constexpr std::array kKinds{VolumeKind::ball, VolumeKind::capsule, VolumeKind::slab, VolumeKind::box};
  const SignedDistance solid(named.mesh);
  const double size = solid.bounds().diagonal();
  const VolumeChoice choice(solid);
  const double least = *std::min_element(errorPercents.begin(), errorPercents.end());
  const VolumeTree tree = growTree(solid, std::span(kKinds).first(1), {least / 100 * size, 2 * mostParts});
  std::vector<SameParts> rows;
  for (const double percent : errorPercents) {
    const std::vector<std::uint32_t> cut = cutAt(tree, percent / 100 * size);
    if (cut.size() > mostParts) break;
    SameParts row{.errorPercent = percent, .parts = cut.size()};
    for (const std::uint32_t node : cut) {
      for (std::size_t k = 0; k < kVolumeKinds; ++k) {
        const VolumeNode one = choice.best(tree.parts[node], std::span(kKinds).subspan(k, 1));
        row.worst[k] = std::max(row.worst[k], 100 * one.error / size);
        row.mean[k] += 100 * one.error / size / static_cast<double>(cut.size());
      }
      const VolumeNode best = choice.best(tree.parts[node], kKinds);
      ++row.chosen[static_cast<std::size_t>(best.volume.kind)];
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace cairn::bench
