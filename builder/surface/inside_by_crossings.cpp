// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/inside_by_crossings.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace cairn::builder {
namespace {

using Voxel = TriangleGrid::Voxel;

/// Arbitrary directions, along no symmetry of any likely mesh.
constexpr std::array<Vec3d, 10> kDirections{{{0.8132, 0.4391, 0.3825},
                                             {-0.4297, 0.6873, -0.5857},
                                             {0.1773, -0.8941, 0.4114},
                                             {-0.7351, -0.2683, 0.6227},
                                             {0.3319, 0.2147, -0.9184},
                                             {-0.6043, 0.7661, 0.2189},
                                             {0.5477, -0.5591, -0.6221},
                                             {-0.2719, -0.7013, -0.6591},
                                             {0.0937, 0.5519, 0.8287},
                                             {0.9511, -0.2237, 0.2131}}};

/// Moeller and Trumbore 1997, reference [75] of the thesis.
bool meets(const std::array<Vec3d, 3>& c, const Vec3d& point, const Vec3d& direction) {
  const Vec3d ab = c[1] - c[0], ac = c[2] - c[0], p = cross(direction, ac);
  const double determinant = dot(ab, p);
  if (determinant == 0) return false;
  const Vec3d fromA = point - c[0], q = cross(fromA, ab);
  const double u = dot(fromA, p) / determinant, v = dot(direction, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && dot(ac, q) / determinant > 0;
}

/// The voxels a ray passes, one after the other.
class Walk {
 public:
  Walk(const TriangleGrid& grid, const Vec3d& point, const Vec3d& direction)
      : size_(grid.size()), voxel_(grid.voxelOf(point)) {
    const Vec3d offset = point - grid.centerOf(voxel_);
    for (int axis = 0; axis < 3; ++axis) {
      const double along = direction[axis];
      if (along == 0) continue;
      forward_[axis] = along > 0;
      step_[axis] = grid.voxelEdge() / std::abs(along);
      next_[axis] = (grid.voxelEdge() / 2 - (along > 0 ? offset[axis] : -offset[axis])) / std::abs(along);
    }
  }

  const Voxel& voxel() const { return voxel_; }

  /// False when the ray leaves the grid.
  bool advance() {
    const auto axis = static_cast<std::size_t>(std::min_element(next_.begin(), next_.end()) - next_.begin());
    if (voxel_[axis] == (forward_[axis] ? size_[axis] - 1 : 0)) return false;
    voxel_[axis] += forward_[axis] ? 1 : -1;
    next_[axis] += step_[axis];
    return true;
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  Voxel size_, voxel_;
  std::array<bool, 3> forward_{};
  std::array<double, 3> step_{}, next_{kNever, kNever, kNever};  // in units of the direction
};

}  // namespace

std::uint32_t InsideByCrossings::crossings(const Vec3d& point, const Vec3d& direction) const {
  std::vector<std::uint32_t> met;  // a triangle may lie in several voxels of the ray
  Walk walk(grid_, point, direction);
  do {
    for (const std::uint32_t t : grid_.trianglesIn(walk.voxel()))
      if (meets(mesh_.corners(t), point, direction)) met.push_back(t);
  } while (walk.advance());
  std::sort(met.begin(), met.end());
  return static_cast<std::uint32_t>(std::unique(met.begin(), met.end()) - met.begin());
}

Vec3d InsideByCrossings::firstDirection() {
  return kDirections.front();
}

bool InsideByCrossings::inside(const Vec3d& point) const {
  if (!grid_.holds(point)) return false;
  int votes = 0;
  for (std::size_t i = 0; i < kDirections.size(); i += 2) {
    for (const Vec3d& direction : {kDirections[i], kDirections[i + 1]})
      votes += crossings(point, direction) % 2 == 1 ? 1 : -1;
    if (votes != 0) break;
  }
  return votes > 0;
}

}  // namespace cairn::builder
