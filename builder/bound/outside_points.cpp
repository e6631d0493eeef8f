// SPDX-License-Identifier: GPL-3.0-or-later
#include "bound/outside_points.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace cairn::builder {
namespace {

/// Walks an octree towards the shell from `error` to `error + spacing` outside. Moves the shell's grid points to its
/// inner side, along the line to their nearest surface point. The distance is exact on that line.
class ShellWalk {
 public:
  ShellWalk(const SignedDistance& solid, double error, double spacing, const KeepGoing& keepGoing)
      : solid_(solid), error_(error), spacing_(spacing), keepGoing_(keepGoing) {}

  void visit(const Vec3d& center, double half, std::vector<Vec3d>& out) const {
    // Smaller cells take some milliseconds with all their parts.
    if (half > 4 * spacing_ && !keepGoing_()) return;
    const SignedDistance::Answer answer = solid_.query(center);
    const double outside = -answer.depth;
    const bool leaf = half <= 0.5 * spacing_;
    const double reach = leaf ? 0 : std::numbers::sqrt3 * half;
    if (outside + reach < error_ || outside - reach > error_ + spacing_) return;
    if (leaf) return draw(center, answer, out);
    for (int octant = 0; octant < 8; ++octant) visit(center + octantOffset(octant, half / 2), half / 2, out);
  }

  static Vec3d octantOffset(int octant, double by) {
    return {octant & 1 ? by : -by, octant & 2 ? by : -by, octant & 4 ? by : -by};
  }

 private:
  void draw(const Vec3d& point, const SignedDistance::Answer& answer, std::vector<Vec3d>& out) const {
    const double wanted = error_ + 8 * solid_.roundingBound(point);
    const Vec3d& foot = answer.nearest.point;
    const Vec3d drawn = foot + (point - foot) * (wanted / answer.nearest.distance);
    if (-solid_.depth(drawn) > error_ + solid_.roundingBound(drawn)) out.push_back(drawn);
  }

  const SignedDistance& solid_;
  double error_, spacing_;
  const KeepGoing& keepGoing_;
};

}  // namespace

std::vector<Vec3d> outsidePoints(const SignedDistance& solid, double error, double spacing,
                                 const KeepGoing& keepGoing) {
  assert(error > 0 && spacing > 0);
  const Vec3d size = solid.bounds().upper - solid.bounds().lower;
  double half = spacing / 2;
  while (half < 0.5 * std::max({size.x, size.y, size.z}) + error + spacing) half *= 2;
  const ShellWalk walk(solid, error, spacing, keepGoing);
  constexpr int kParts = 64;  // two levels of octants, for the threads
  std::array<std::vector<Vec3d>, kParts> parts;
  tbb::parallel_for(0, kParts, [&](int i) {
    const Vec3d offset = ShellWalk::octantOffset(i / 8, half / 2) + ShellWalk::octantOffset(i % 8, half / 4);
    walk.visit(solid.bounds().center() + offset, half / 4, parts[i]);
  });
  std::vector<Vec3d> all;
  for (const std::vector<Vec3d>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace cairn::builder
