// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/triangle_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "surface/triangle_in_cube.h"

namespace cairn::builder {
namespace {

/// Triangles are sorted into voxels widened by this fraction of their edge, far more than the rounding of any query.
constexpr double kSlack = 1e-9;
constexpr double kMaxPerSide = 256;  // 17 million voxels, 70 MB

/// A surface meets about six times the square of the voxels along a side.
double defaultPerSide(std::size_t triangles) {
  return std::ceil(std::sqrt(static_cast<double>(triangles) / 6));
}

}  // namespace

TriangleGrid::TriangleGrid(const TriangleMesh& mesh, std::uint32_t perSide) : bounds_(boundsOf(mesh)) {
  assert(!mesh.triangles.empty());
  const double wanted = perSide != 0 ? perSide : defaultPerSide(mesh.triangles.size());
  const Vec3d extent = bounds_.upper - bounds_.lower;
  edge_ = std::max({extent.x, extent.y, extent.z}) / std::clamp(wanted, 1.0, kMaxPerSide);
  for (int axis = 0; axis < 3; ++axis)
    size_[axis] = static_cast<std::uint32_t>(std::clamp(std::ceil(extent[axis] / edge_), 1.0, kMaxPerSide));
  first_.assign(std::size_t{size_[0]} * size_[1] * size_[2] + 1, 0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    forVoxelsOf(mesh.corners(t), [&](std::size_t voxel) { ++first_[voxel + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  list_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    forVoxelsOf(mesh.corners(t), [&](std::size_t voxel) { list_[next[voxel]++] = t; });
}

template <class Visit>
void TriangleGrid::forVoxelsOf(const std::array<Vec3d, 3>& corners, const Visit& visit) const {
  Vec3d lower = corners[0], upper = corners[0];
  for (const Vec3d& c : corners) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], c[axis]);
      upper[axis] = std::max(upper[axis], c[axis]);
    }
  }
  const double slack = kSlack * edge_;
  const Voxel from = voxelOf(lower - Vec3d{slack, slack, slack}), to = voxelOf(upper + Vec3d{slack, slack, slack});
  Voxel v;
  for (v[2] = from[2]; v[2] <= to[2]; ++v[2])
    for (v[1] = from[1]; v[1] <= to[1]; ++v[1])
      for (v[0] = from[0]; v[0] <= to[0]; ++v[0])
        if (from == to || triangleMeetsCube(corners, centerOf(v), edge_ * (0.5 + kSlack))) visit(indexOf(v));
}

bool TriangleGrid::holds(const Vec3d& point) const {
  for (int axis = 0; axis < 3; ++axis)
    if (!(point[axis] >= bounds_.lower[axis] && point[axis] <= bounds_.upper[axis])) return false;
  return true;
}

TriangleGrid::Voxel TriangleGrid::voxelOf(const Vec3d& point) const {
  Voxel voxel{};
  for (int axis = 0; axis < 3; ++axis) {
    const double position = (point[axis] - bounds_.lower[axis]) / edge_;
    voxel[axis] = static_cast<std::uint32_t>(std::clamp(position, 0.0, size_[axis] - 1.0));
  }
  return voxel;
}

Vec3d TriangleGrid::centerOf(const Voxel& voxel) const {
  return bounds_.lower + Vec3d{voxel[0] + 0.5, voxel[1] + 0.5, voxel[2] + 0.5} * edge_;
}

}  // namespace cairn::builder
