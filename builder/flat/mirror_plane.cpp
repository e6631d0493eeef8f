// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "flat/mirror.h"
#include "surface/farthest_point.h"
#include "surface/mass_properties.h"

namespace cairn::builder {
namespace {

/// Vertices a plane is tried on before its deviation is proved, and pairs of vertices whose middle planes are tried.
constexpr std::size_t kTrialVertices = 200, kPairs = 400;
/// A proof costs much more than a trial: the planes tried with the least deviations are proved.
constexpr std::size_t kProofs = 4;

class PlaneSearch {
 public:
  explicit PlaneSearch(const TriangleMesh& mesh)
      : mesh_(mesh),
        surface_(mesh),
        diagonal_(boundsOf(mesh).diagonal()),
        mass_(massPropertiesOf(mesh)),
        step_(std::max<std::size_t>(1, mesh.vertices.size() / kTrialVertices)) {}

  std::optional<MirrorPlane> run() {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d normal;
      normal[axis] = 1;
      offer(normal);
      offer(mass_.principalAxes.column(axis));
    }
    offerMiddlePlanes();
    std::stable_sort(tried_.begin(), tried_.end(),
                     [](const MirrorPlane& a, const MirrorPlane& b) { return a.deviation < b.deviation; });
    std::optional<MirrorPlane> best;
    for (std::size_t i = 0; i < std::min(kProofs, tried_.size()); ++i) {
      MirrorPlane plane = tried_[i];
      plane.deviation = provedDeviation(plane);
      if (plane.deviation <= kMirrorTolerance * diagonal_ && (!best || plane.deviation < best->deviation)) best = plane;
    }
    return best;
  }

 private:
  static Vec3d reflected(const MirrorPlane& plane, const Vec3d& p) {
    return Mirror{plane.normal, plane.offset}.reflected(p);
  }

  /// Keeps a plane through the centre of mass whose images of some vertices lie near the surface.
  void offer(const Vec3d& normal) {
    MirrorPlane plane{normal, dot(normal, mass_.centerOfMass), 0};
    for (std::size_t v = 0; v < mesh_.vertices.size(); v += step_) {
      plane.deviation = std::max(plane.deviation, surface_.closest(reflected(plane, mesh_.vertices[v])).distance);
      if (plane.deviation > kMirrorTolerance * diagonal_) return;
    }
    tried_.push_back(plane);
  }

  /// Where moments are equal the axes say nothing: the image of the farthest vertex is then about as far.
  void offerMiddlePlanes() {
    const auto out = [&](const Vec3d& v) { return distance(v, mass_.centerOfMass); };
    const Vec3d far = *std::max_element(mesh_.vertices.begin(), mesh_.vertices.end(),
                                        [&](const Vec3d& a, const Vec3d& b) { return out(a) < out(b); });
    std::size_t pairs = 0;
    for (const Vec3d& v : mesh_.vertices) {
      const Vec3d apart = v - far;
      if (std::abs(out(v) - out(far)) > kMirrorTolerance * diagonal_ || length(apart) < 0.01 * diagonal_) continue;
      if (++pairs > kPairs) return;
      offer(normalized(apart));
    }
  }

  double provedDeviation(const MirrorPlane& plane) const {
    TriangleMesh image = mesh_;
    for (Vec3d& v : image.vertices) v = reflected(plane, v);
    return farthestPoint(image, surface_, {.relative = 0.01, .absolute = 1e-6 * diagonal_}).upper;
  }

  const TriangleMesh& mesh_;
  SurfaceDistance surface_;
  double diagonal_;
  MassProperties mass_;
  std::size_t step_;
  std::vector<MirrorPlane> tried_;
};

}  // namespace

Mirror intoBody(const MirrorPlane& plane, const BodyFrame& frame) {
  const Vec3d on = frame.into(plane.normal * plane.offset);
  const Vec3d normal = normalized(frame.into(plane.normal * (plane.offset + frame.unit())) - on);
  return {normal, dot(normal, on)};
}

std::optional<MirrorPlane> mirrorPlaneOf(const TriangleMesh& mesh) {
  return PlaneSearch(mesh).run();
}

}  // namespace cairn::builder
