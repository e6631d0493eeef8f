// SPDX-License-Identifier: Zlib
#include <algorithm>
#include <limits>
#include <vector>

#include "cairn/core/surface_ray.h"
#include "cairn/core/tree_surface.h"
#include "thickness_samples.h"

namespace cairn {

namespace {

constexpr double kThinPart = 0.1;

ThicknessSample measured(const SurfaceView& surface, std::uint32_t triangle, SurfaceRay& ray) {
  const auto& t = surface.triangles[triangle];
  const Vec3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
  const Vec3 middle = (a + b + c) / 3.0F;
  return {ray.cast(surface, middle, -surface.features().faces()[triangle].normal, triangle).distance,
          length(cross(b - a, c - a))};
}

}  // namespace

// Every so many faces, in the order of the file: neighbours there are neighbours on the body.
float surfaceThickness(const SurfaceView& surface) {
  const auto count = static_cast<std::uint32_t>(surface.triangles.size());
  const std::uint32_t stride = (count + kThicknessSamples - 1) / kThicknessSamples;
  std::vector<ThicknessSample> samples;
  SurfaceRay ray;
  for (std::uint32_t t = 0; t < count; t += stride) samples.push_back(measured(surface, t, ray));
  return thinnestTenth(samples);
}

float thinnestTenth(std::vector<ThicknessSample>& samples) {
  double area = 0, sum = 0;
  for (const ThicknessSample& sample : samples) area += double(sample.area);
  std::ranges::stable_sort(samples, {}, &ThicknessSample::thickness);  // stable: sums in one order with every library
  for (const ThicknessSample& sample : samples)
    if ((sum += double(sample.area)) >= kThinPart * area) return sample.thickness;
  return std::numeric_limits<float>::infinity();
}

}  // namespace cairn
