// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cairn/core/vec3.h"
#include "scenes/bodies/lattice_noise.h"

namespace cairn::scenes {

/// A worn unit ball as a function of direction: flat cuts, dents and roughness. Each ray from the centre has one
/// surface point. So meshes whose vertices move to that point stay closed and free of self-intersections.
class WornSurface {
 public:
  explicit WornSurface(std::uint64_t noiseSeed) : noise_(noiseSeed) {}

  /// Cuts along a plane at `distance` from the centre, below 1. `normal` has length 1.
  void cut(const Vec3d& normal, double distance) { cuts_.push_back({normal, distance}); }
  /// Adds a dent. `width`: a chord of the unit sphere. `depth`: fraction of the distance there, below 1.
  void dent(const Vec3d& direction, double width, double depth) { dents_.push_back({direction, width, depth}); }
  /// True when every dent is farther from a direction than a chord of length `apart`.
  bool isFree(const Vec3d& direction, double apart) const {
    return std::ranges::all_of(dents_, [&](const Dent& d) { return distance(d.direction, direction) > apart; });
  }

  /// Returns the distance of the surface from the centre along a unit direction. `roughness`: fraction of the full
  /// roughness, 0..1.
  double radius(const Vec3d& direction, double roughness = 1) const {
    double radius = 1;
    for (const Cut& cut : cuts_) {
      const double facing = dot(direction, cut.normal);
      if (facing > 0) radius = std::min(radius, cut.distance / facing);
    }
    for (const Dent& dent : dents_) {
      const double t = 1 - lengthSq(direction - dent.direction) / (dent.width * dent.width);
      if (t > 0) radius *= 1 - dent.depth * t * t * (3 - 2 * t);
    }
    return radius * (1 + roughness * 0.05 * noise_(direction * 2.5) + roughness * 0.02 * noise_(direction * 7));
  }

 private:
  struct Cut {
    Vec3d normal;
    double distance;
  };
  struct Dent {
    Vec3d direction;
    double width, depth;
  };

  LatticeNoise noise_;
  std::vector<Cut> cuts_;
  std::vector<Dent> dents_;
};

}  // namespace cairn::scenes
