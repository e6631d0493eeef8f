// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/uncovered_area.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "surface/random_stream.h"

namespace cairn::builder {
namespace {

constexpr std::size_t kAreaSamples = 100'000;
constexpr std::size_t kChunk = 1'000;  // samples of one random stream

/// cumulative[i] = sum of the weights before i; one entry more than weights.
std::vector<double> cumulated(const std::vector<double>& weights) {
  std::vector<double> sums(weights.size() + 1, 0);
  for (std::size_t i = 0; i < weights.size(); ++i) sums[i + 1] = sums[i] + weights[i];
  return sums;
}

/// Returns the interval that holds `position`, at or after `from`; calls have ascending positions.
std::size_t intervalAt(const std::vector<double>& sums, double position) {
  const auto after = std::upper_bound(sums.begin(), sums.end(), position);
  const auto index = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - sums.begin() - 1, 0));
  return std::min(index, sums.size() - 2);
}

std::vector<double> areasOf(const TriangleMesh& mesh) {
  std::vector<double> areas;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = mesh.corners(t);
    areas.push_back(length(cross(c[1] - c[0], c[2] - c[0])) / 2);
  }
  return areas;
}

Vec3d uniformPoint(const std::array<Vec3d, 3>& corners, RandomStream& random) {
  const double root = std::sqrt(random.uniform()), along = random.uniform();
  return corners[0] * (1 - root) + corners[1] * (root * (1 - along)) + corners[2] * (root * along);
}

/// The balls that meet a triangle's bounding sphere.
void collectNear(const std::array<Vec3d, 3>& corners, const std::vector<CutBall>& balls, std::vector<CutBall>& near) {
  near.clear();
  const Vec3d middle = (corners[0] + corners[1] + corners[2]) / 3;
  double reach = 0;
  for (const Vec3d& c : corners) reach = std::max(reach, distance(c, middle));
  for (const CutBall& ball : balls) {
    const double touch = (ball.radius + reach) * (1 + 1e-12);  // rounding; extra balls do no harm
    if (lengthSq(ball.center - middle) <= touch * touch) near.push_back(ball);
  }
}

/// Runs `chunk(index)`, which returns a number, over all chunks in parallel and sums in order.
template <class Chunk>
double sumOverChunks(std::size_t samples, const Chunk& chunk) {
  std::vector<double> parts(samples / kChunk);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) { parts[i] = chunk(i); });
  double sum = 0;
  for (const double part : parts) sum += part;
  return sum;
}

}  // namespace

double uncoveredAreaFraction(const TriangleMesh& mesh, const std::vector<CutBall>& balls, std::uint64_t seed) {
  const std::vector<double> sums = cumulated(areasOf(mesh));
  const double outside = sumOverChunks(kAreaSamples, [&](std::size_t chunk) {
    RandomStream random(seed, chunk);
    std::vector<CutBall> near;
    std::size_t nearTo = mesh.triangles.size();
    double count = 0;
    for (std::size_t i = chunk * kChunk; i < (chunk + 1) * kChunk; ++i) {
      const double position = (static_cast<double>(i) + random.uniform()) / kAreaSamples * sums.back();
      const std::size_t triangle = intervalAt(sums, position);
      const auto corners = mesh.corners(static_cast<std::uint32_t>(triangle));
      if (triangle != nearTo) collectNear(corners, balls, near);
      nearTo = triangle;
      const Vec3d point = uniformPoint(corners, random);
      count += std::none_of(near.begin(), near.end(), [&](const CutBall& b) { return b.contains(point); });
    }
    return count;
  });
  return outside / kAreaSamples;
}

}  // namespace cairn::builder
