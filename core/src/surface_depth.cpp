// SPDX-License-Identifier: Zlib
#include "cairn/core/surface_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "refit_tuning.h"

namespace cairn {

namespace {

struct Nearest {
  double distanceSq = std::numeric_limits<double>::infinity();
  Vec3d away;  // from the nearest point of the surface to the point asked for
  std::uint32_t triangle = 0;
  std::uint32_t corner = 0;   // the first of the side, or the only one
  std::uint32_t corners = 3;  // of what is nearest: 3 for the face, 2 for a side
};

using Corners = std::array<Vec3d, 3>;

Corners cornersOf(const SurfaceView& surface, std::uint32_t triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  return {Vec3d(surface.vertices[a]), Vec3d(surface.vertices[b]), Vec3d(surface.vertices[c])};
}

Vec3d areaOf(const Corners& v) {
  return cross(v[1] - v[0], v[2] - v[0]);
}

Vec3d normalOf(const SurfaceView& surface, std::uint32_t triangle) {
  const Vec3d area = areaOf(cornersOf(surface, triangle));
  const double norm = length(area);
  return norm > 0 ? area / norm : Vec3d();
}

void meet(const SurfaceView& surface, std::uint32_t triangle, const Vec3d& p, Nearest& nearest) {
  const Corners v = cornersOf(surface, triangle);
  const Vec3d area = areaOf(v);
  const double norm = lengthSq(area);
  if (!(norm > 0)) return;
  const auto take = [&](const Vec3d& away, std::uint32_t corner, std::uint32_t corners) {
    if (lengthSq(away) < nearest.distanceSq) nearest = {lengthSq(away), away, triangle, corner, corners};
  };
  bool isAbove = true;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3d side = v[(k + 1) % 3] - v[k], to = p - v[k];
    if (dot(cross(area, side), to) >= 0) continue;
    isAbove = false;
    const double along = dot(to, side), whole = lengthSq(side);
    if (along <= 0)
      take(to, k, 1);
    else if (along >= whole)
      take(p - v[(k + 1) % 3], (k + 1) % 3, 1);
    else
      take(to - side * (along / whole), k, 2);
  }
  if (isAbove) take(area * (dot(area, p - v[0]) / norm), 0, 3);
}

double angleAt(const SurfaceView& surface, std::uint32_t triangle, std::uint32_t vertex) {
  const auto& t = surface.triangles[triangle];
  const auto k = static_cast<std::size_t>(std::ranges::find(t, vertex) - t.begin());
  const Corners v = cornersOf(surface, triangle);
  const Vec3d a = v[(k + 1) % 3] - v[k], b = v[(k + 2) % 3] - v[k];
  return std::atan2(length(cross(a, b)), dot(a, b));
}

// Zero where the surface ends.
Vec3d normalAt(const SurfaceView& surface, const Nearest& nearest) {
  if (nearest.corners == 3) return normalOf(surface, nearest.triangle);
  const SurfaceFeatures& features = surface.features();
  if (nearest.corners == 2) {
    const SurfaceEdge& edge = features.edges()[features.edgesOf()[nearest.triangle][nearest.corner]];
    if (edge.triangle[1] == SurfaceEdge::kNone) return {};
    return normalOf(surface, edge.triangle[0]) + normalOf(surface, edge.triangle[1]);
  }
  // Each triangle twice: by both of its sides that meet here.
  const std::uint32_t vertex = surface.triangles[nearest.triangle][nearest.corner];
  Vec3d sum;
  for (const std::uint32_t e : features.edgesAround(vertex))
    for (const std::uint32_t triangle : features.edges()[e].triangle) {
      if (triangle == SurfaceEdge::kNone) return {};
      sum += normalOf(surface, triangle) * angleAt(surface, triangle, vertex);
    }
  return sum;
}

using Lanes = std::array<float, PatchFamily::kWidth>;

// Squared distances to a family's boxes, by lane; never more than the true ones.
Lanes boxDistancesSq(const PatchFamily& family, const Vec3& p) {
  const std::array<float, 3> at{p.x, p.y, p.z};
  Lanes sums{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t lane = 0; lane < PatchFamily::kWidth; ++lane) {
      const float below = family.lower[axis][lane] - at[axis], above = at[axis] - family.upper[axis][lane];
      const float more = below > above ? below : above, apart = more > 0 ? more : 0;
      sums[lane] += apart * apart;
    }
  for (float& sum : sums) sum *= refit::kBoxRounding;
  return sums;
}

// Squared distances to a patch's triangles, by lane; never more than the true ones. A triangle is no nearer than its
// plane and, in it, than each line through a side that it lies beyond. `slack`: what floats take from a distance.
Lanes faceDistancesSq(const SurfacePatch& patch, const Vec3& p, float slack) {
  constexpr std::size_t kWidth = PatchFamily::kWidth;
  const auto heights = [&](int plane) {
    const float* const n = patch.faceColumns + static_cast<std::size_t>(4 * plane) * kWidth;
    Lanes out;
    for (std::size_t lane = 0; lane < kWidth; ++lane)
      out[lane] = p.x * n[lane] + p.y * n[kWidth + lane] + p.z * n[2 * kWidth + lane] - n[3 * kWidth + lane];
    return out;
  };
  const Lanes above = heights(0), first = heights(1), second = heights(2), third = heights(3);
  Lanes sums;
  for (std::size_t lane = 0; lane < kWidth; ++lane) {
    const float off = above[lane] > 0 ? above[lane] : -above[lane];
    float inside = first[lane] < second[lane] ? first[lane] : second[lane];
    inside = third[lane] < inside ? third[lane] : inside;
    const float up = off > slack ? off - slack : 0, beside = -inside > slack ? -inside - slack : 0;
    sums[lane] = (up * up + beside * beside) * refit::kBoxRounding;
  }
  return sums;
}

float largestCoordinate(const SurfacePatches& patches, const Vec3& p) {
  float most = 0;
  for (const Vec3& v : {patches.box().lower, patches.box().upper, p})
    most = std::max({most, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return most;
}

}  // namespace

SurfaceDepth SurfaceDepthSearch::at(const SurfaceView& surface, const Vec3& point, std::uint32_t guess) {
  const Vec3d p(point);
  const SurfacePatches& patches = surface.patches();
  const float slack = refit::kFaceRounding * largestCoordinate(patches, point);
  Nearest nearest;
  meet(surface, guess, p, nearest);
  waiting_.assign(1, {0, 0, false});
  while (!waiting_.empty()) {
    const Waiting next = waiting_.back();
    waiting_.pop_back();
    if (!(double(next.distanceSq) < nearest.distanceSq)) continue;
    if (next.isPatch) {
      const SurfacePatch patch = patches.patch(next.child);
      const Lanes distancesSq = faceDistancesSq(patch, point, slack);
      for (std::size_t i = 0; i < patch.triangles.size(); ++i)
        if (double(distancesSq[i]) < nearest.distanceSq) meet(surface, patch.triangles[i], p, nearest);
      continue;
    }
    const PatchFamily& family = patches.families()[next.child];
    const Lanes distancesSq = boxDistancesSq(family, point);
    const std::size_t before = waiting_.size();
    for (std::uint32_t lane = 0; lane < PatchFamily::kWidth; ++lane)
      if (double(distancesSq[lane]) < nearest.distanceSq && family.lower[0][lane] <= family.upper[0][lane])
        waiting_.push_back({distancesSq[lane], family.child[lane], family.isPatch(lane)});
    std::sort(waiting_.begin() + static_cast<std::ptrdiff_t>(before), waiting_.end(),
              [](const Waiting& a, const Waiting& b) { return a.distanceSq > b.distanceSq; });
  }
  const double distance = std::sqrt(nearest.distanceSq);
  const Vec3d normal = normalAt(surface, nearest);
  const bool isInside = dot(normal, nearest.away) < -refit::kDoubt * length(normal) * distance;
  return {isInside ? distance : -distance, nearest.away, nearest.triangle};
}

}  // namespace cairn
