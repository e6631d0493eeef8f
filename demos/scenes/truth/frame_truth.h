// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "scenes/truth/exact_check.h"
#include "scenes/truth/placed_body.h"
#include "scenes/world/world.h"

namespace cairn::scenes {

/// Two bodies by number, the smaller first.
using BodyPair = std::pair<int, int>;
inline BodyPair bodyPair(int a, int b) {
  return std::minmax({a, b});
}

/// The exact state of the bodies of one frame, by the exact check, without any code of the judged shapes. Lengths in
/// metres. Surface and model must outlive this object.
class FrameTruth {
 public:
  /// Finds the pairs that meet. Cost: tens of microseconds for each pair with overlapping boxes.
  FrameTruth(const ExactSurface& surface, const Model& model, std::span<const BodyMotion> motions);

  /// Returns the pairs whose meshes have a common point, in ascending order.
  const std::vector<BodyPair>& meeting() const { return meeting_; }
  bool meets(const BodyPair& pair) const;

  /// Returns the distance between the meshes of a pair, 0 if they meet. Takes milliseconds at the first call, then the
  /// result is cached.
  double gap(const BodyPair& pair);
  /// Returns the larger penetration of the pair's meshes, within `kDepthToleranceFraction` of body size.
  double depth(const BodyPair& pair) const;
  /// Returns the distance from a body's mesh to a point in the world frame.
  double distanceFromMesh(int body, const Vec3d& point) const;
  /// Returns the distance of a point (world frame) outside a body; 0 inside.
  double distanceFromSolid(int body, const Vec3d& point) const;

 private:
  Placement relative(const BodyPair& pair) const;

  const ExactSurface& surface_;
  double size_;
  std::vector<Placement> worldFromBody_;
  std::vector<BodyPair> meeting_;
  std::map<BodyPair, double> gaps_;
};

}  // namespace cairn::scenes
