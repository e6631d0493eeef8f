// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <random>
#include <vector>

#include "cpu_seconds.h"
#include "random_tree.h"
#include "volumes/measure.h"
#include "volumes/overlap.h"
#include "volumes/random_volumes.h"

namespace cairn::bench {
namespace {

constexpr std::size_t kVolumes = 256;

/// Seconds of moving each of `b` and testing it against each volume of `a` in its turn.
template <class Volume>
double secondsOfTests(const std::vector<Volume>& a, const std::vector<Volume>& b, const RigidMove& move) {
  std::size_t hits = 0;
  const double start = cpuSeconds();
  for (std::size_t shift = 0; shift < a.size(); ++shift)
    for (std::size_t i = 0; i < b.size(); ++i) hits += mayMeet(a[(i + shift) % a.size()], move * b[i], 0) ? 1 : 0;
  const double seconds = cpuSeconds() - start;
  volatile std::size_t proofOfWork = hits;
  (void)proofOfWork;
  return seconds;
}

template <class Volume>
double nanoseconds(const std::vector<Volume>& a, const std::vector<Volume>& b, const RigidMove& move,
                   std::size_t runs) {
  std::vector<double> seconds;
  for (std::size_t run = 0; run < runs; ++run) seconds.push_back(secondsOfTests(a, b, move));
  std::sort(seconds.begin(), seconds.end());
  return 1e9 * seconds[runs / 2] / static_cast<double>(a.size() * b.size());
}

}  // namespace

PairCosts measurePairCosts(const MeasureOptions& options) {
  std::mt19937_64 engine(options.seed);
  std::array<std::vector<SweptBall>, kVolumeKinds> volumes;
  for (std::size_t k = 0; k < kVolumeKinds; ++k)
    for (std::size_t i = 0; i < kVolumes; ++i) volumes[k].push_back(randomVolume(static_cast<VolumeKind>(k), engine));
  const RigidMove move{test::randomRotation(engine), test::randomPoint(engine) * 0.1};
  PairCosts costs;
  std::vector<PlainBall> plain;
  for (const SweptBall& ball : volumes[0]) plain.push_back({ball.center, ball.radius});
  costs.plainBalls = nanoseconds(plain, plain, move, options.runs);
  for (std::size_t a = 0; a < kVolumeKinds; ++a)
    for (std::size_t b = 0; b < kVolumeKinds; ++b)
      costs.ofKinds[a][b] = nanoseconds(volumes[a], volumes[b], move, options.runs);
  return costs;
}

}  // namespace cairn::bench
