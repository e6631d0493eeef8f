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

/// Two bodies by their numbers, the smaller first.
using BodyPair = std::pair<int, int>;
inline BodyPair bodyPair(int a, int b) {
  return std::minmax({a, b});
}

/// What is true of the bodies of one frame, by the exact check: no code of the shapes that are judged. Lengths in
/// metres. Surface and model must outlive it.
class FrameTruth {
 public:
  /// Finds the pairs that meet: tens of microseconds for each pair whose boxes overlap.
  FrameTruth(const ExactSurface& surface, const Model& model, std::span<const BodyMotion> motions);

  /// Pairs whose meshes have a point in common, in order.
  const std::vector<BodyPair>& meeting() const { return meeting_; }
  bool meets(const BodyPair& pair) const;

  /// How far apart the meshes of a pair are, 0 if they meet. Milliseconds the first time, then kept.
  double gap(const BodyPair& pair);
  /// How deep either mesh of a pair reaches into the other, within `kDepthToleranceFraction` of body size.
  double depth(const BodyPair& pair) const;
  /// Distance of a point, world frame, from the mesh of a body.
  double distanceFromMesh(int body, const Vec3d& point) const;
  /// How far a point, world frame, is outside a body; 0 inside.
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
