// SPDX-License-Identifier: Zlib
#include "refit_thickness.h"

#include <cmath>

#include "cairn/core/surface_ray.h"

namespace cairn {

std::vector<FacingPlaces> facingPlaces(const SphereTree& tree) {
  const auto count = static_cast<std::uint32_t>(tree.triangles().size());
  const std::uint32_t stride = (count + kThicknessSamples - 1) / kThicknessSamples;
  std::vector<FacingPlaces> places;
  SurfaceRay ray;
  for (std::uint32_t t = 0; t < count; t += stride) {
    const FixedPlace from{t, 1.0 / 3, 1.0 / 3};
    const Vec3 middle(whereIs(tree, from)), inwards = -tree.surface().features.faces()[t].normal;
    const SurfaceHit hit = ray.cast(tree.surfaceView(), middle, inwards, t);
    if (!std::isfinite(hit.distance)) continue;
    places.push_back({from, placeOn(tree, hit.triangle, Vec3d(middle) + Vec3d(inwards) * double(hit.distance))});
  }
  return places;
}

float thicknessOf(const SphereTree& tree, std::span<const FacingPlaces> places, std::vector<ThicknessSample>& samples) {
  samples.clear();
  for (const FacingPlaces& p : places) {
    const auto& [a, b, c] = tree.triangles()[p.from.triangle];
    const std::span<const Vec3> v = tree.vertices();
    samples.push_back({static_cast<float>(distance(whereIs(tree, p.from), whereIs(tree, p.to))),
                       length(cross(v[b] - v[a], v[c] - v[a]))});
  }
  return thinnestTenth(samples);
}

}  // namespace cairn
