// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "certify/protrusion.h"
#include "surface/signed_distance.h"
#include "volumes/fit.h"
#include "volumes/flat_faces.h"
#include "volumes/surface_part.h"
#include "volumes/swept_ball.h"

namespace cairn::bench {

/// A volume around a part of the surface, with its certified error. Mesh frame and unit.
struct VolumeNode {
  SweptBall volume;
  double error = 0;              ///< no point of the volume is farther from the solid
  std::uint32_t firstChild = 0;  ///< of two that follow each other; 0: none
};

/// A binary tree of volumes over one surface. The root is node 0.
struct VolumeTree {
  std::vector<VolumeNode> nodes;
  std::vector<SurfacePart> parts;  ///< by node
};

/// The kinds of volume a tree may use.
struct KindSet {
  const char* name;
  std::vector<VolumeKind> kinds;
};

struct GrowthLimits {
  double error = 0;                  ///< mesh unit; volumes that err less are not divided
  std::size_t mostNodes = 1U << 18;  ///< growth ends at this many nodes, or the next even number
};

/// Finds the volume around a part with the least certified error times pair cost. Both a tenfold cost and a tenfold
/// error ask for ten times the work: on rods and on curved surfaces the number of volumes is inverse to the error.
/// Errors below the tolerance of certificates count as equal.
class VolumeChoice {
 public:
  /// Keeps a reference to the solid.
  explicit VolumeChoice(const builder::SignedDistance& solid);

  VolumeNode best(const SurfacePart& part, std::span<const VolumeKind> kinds) const;
  /// What `best` would minimise, with the estimate for the certified error: cheaper, and near.
  double weighedEstimate(const SurfacePart& part, std::span<const VolumeKind> kinds) const;

 private:
  const builder::SignedDistance& solid_;
  FlatFaces faces_;
  VolumeFit fit_;
  builder::ProtrusionTolerance tolerance_;
};

/// Grows a tree breadth first: each volume that errs too much is cut along the plane after which the two estimates,
/// each times its pair cost, have the least sum of squares. All sets of kinds are grown by this one rule, each with its
/// own planes. Deterministic.
VolumeTree growTree(const builder::SignedDistance& solid, std::span<const VolumeKind> kinds,
                    const GrowthLimits& limits);

/// Nodes that a traversal down to `error` ends at: the first on each path that err no more, or a leaf.
std::vector<std::uint32_t> cutAt(const VolumeTree& tree, double error);

}  // namespace cairn::bench
