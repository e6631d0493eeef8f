// SPDX-License-Identifier: Zlib
#include "cairn/core/viewer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cairn {

namespace {
double angleBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}
}  // namespace

Status checkViewer(const Viewer& viewer) {
  if (!isFinite(viewer.eye) || !isFinite(viewer.direction) || !isFinite(viewer.focus))
    return Error{"a viewer's eye, direction and focus must be finite numbers"};
  if (!(lengthSq(viewer.direction) > 0))
    return Error{"a viewer must look somewhere: give a direction that is not zero"};
  if (!(viewer.fieldOfView > 0 && viewer.fieldOfView <= 2 * std::numbers::pi))
    return Error{"a viewer's field of view must be an angle above 0 and at most 2 pi radians"};
  return {};
}

Sight sightOf(const Viewer& viewer, const Vec3d& center, double radius) {
  const Vec3d line = center - viewer.eye;
  const double distance = length(line);
  if (!std::isfinite(distance)) return {std::numeric_limits<double>::infinity(), std::numbers::pi, false};
  if (distance <= radius) return {radius, 0, true};  // the eye is inside
  const double halfAngle = std::asin(radius / distance);
  const Vec3d gaze = viewer.focus == viewer.eye ? viewer.direction : viewer.focus - viewer.eye;
  Sight sight;
  sight.distance = distance;
  sight.eccentricity = std::max(0.0, angleBetween(gaze, line) - halfAngle);
  sight.isVisible = angleBetween(viewer.direction, line) - halfAngle <= viewer.fieldOfView / 2;
  return sight;
}

double acuityAt(double eccentricity) {
  return 1 / (1 + eccentricity / kHalfAcuityEccentricity);
}

double seenError(const Sight& sight, double error) {
  return sight.isVisible ? error / sight.distance * acuityAt(sight.eccentricity) : 0;
}

}  // namespace cairn
