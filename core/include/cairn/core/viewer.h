// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn {

/// Who looks at a scene, and at what. World frame; lengths in world units, angles in radians.
struct Viewer {
  Vec3d eye;                  ///< where the viewer stands
  Vec3d direction{0, 0, -1};  ///< of the middle of the view; any length but zero
  /// The point the gaze rests on. A viewer about whose gaze nothing is known looks straight ahead: any point along
  /// `direction`, or the eye itself, which stands for them.
  Vec3d focus;
  double fieldOfView = 1;  ///< whole angle of the cone that is seen, in (0, 2 pi]
};

/// Refuses what is not finite, a direction of length zero and a field of view out of range, in one sentence.
CAIRN_CORE_EXPORT
Status checkViewer(const Viewer& viewer);

/// How a viewer sees a ball.
struct Sight {
  double distance = 1;      ///< world length from the eye to the centre, at least the radius
  double eccentricity = 0;  ///< radians between the gaze and the nearest part of the ball
  bool isVisible = true;    ///< some of the ball is inside the field of view; nothing is known of what hides it
};

/// `center` and `radius` (world length, > 0) describe the ball. A ball that is infinitely far away, or at NaN, is not
/// visible.
CAIRN_CORE_EXPORT
Sight sightOf(const Viewer& viewer, const Vec3d& center, double radius);

/// Eccentricity at which two things must be twice as far apart as at the gaze to be told apart: 2.5 degrees, in the
/// middle of what is measured with gratings (Strasburger, Rentschler and Juettner 2011, table 4).
inline constexpr double kHalfAcuityEccentricity = 0.0436;

/// Acuity away from the gaze relative to that at it, 1 / (1 + eccentricity / kHalfAcuityEccentricity): the angle that
/// can be resolved grows linearly with eccentricity (Weymouth 1958; Levi, Klein and Aitsebaomo 1985).
CAIRN_CORE_EXPORT
double acuityAt(double eccentricity);

/// The angle in radians at which an error of world length `error` is seen: projected from its distance and weighed by
/// acuity, so that it compares with a gap seen at the gaze; 0 when nothing of the ball is in view. For small angles.
CAIRN_CORE_EXPORT
double seenError(const Sight& sight, double error);

}  // namespace cairn
