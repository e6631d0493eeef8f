// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "surface/signed_distance.h"
#include "volumes/surface_part.h"
#include "volumes/swept_ball.h"

namespace cairn::bench {

/// A volume around a part of the surface, and an estimate of its certified error, cheap enough to compare fits by.
struct Fit {
  SweptBall volume;
  double estimate = 0;  ///< radius less depth of the core, at a few of its points; mesh unit
};

/// Fits volumes to parts of one solid's surface. Each holds its part: the radius is the greatest distance of a corner
/// from the core, rounded outward, and a convex volume that holds the corners holds the triangles.
class VolumeFit {
 public:
  /// Keeps a reference to the solid.
  explicit VolumeFit(const builder::SignedDistance& solid);

  /// The volume of this kind with the least estimate found. Nothing where the part has no extent to sweep along.
  /// Precondition: the part is not empty. Some hundred queries.
  std::optional<Fit> operator()(VolumeKind kind, const SurfacePart& part) const;

 private:
  const builder::SignedDistance& solid_;
  double guard_;
};

}  // namespace cairn::bench
