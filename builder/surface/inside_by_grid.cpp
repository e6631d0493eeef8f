// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/inside_by_grid.h"

#include <algorithm>
#include <utility>

namespace cairn::builder {

InsideByGrid::InsideByGrid(const TriangleMesh& mesh, Test test, std::uint32_t perSide)
    : grid_(mesh, perSide), test_(std::move(test)) {
  const TriangleGrid::Voxel& size = grid_.size();
  sides_.resize(std::size_t{size[0]} * size[1] * size[2], Side::undetermined);
  TriangleGrid::Voxel v;
  for (v[2] = 0; v[2] < size[2]; ++v[2])
    for (v[1] = 0; v[1] < size[1]; ++v[1])
      for (v[0] = 0; v[0] < size[0]; ++v[0])
        if (grid_.trianglesIn(v).empty())
          sides_[grid_.indexOf(v)] = test_(grid_.centerOf(v)) ? Side::inside : Side::outside;
}

bool InsideByGrid::inside(const Vec3d& point) const {
  if (!grid_.holds(point)) return false;
  const Side side = sides_[grid_.indexOf(grid_.voxelOf(point))];
  return side == Side::undetermined ? test_(point) : side == Side::inside;
}

double InsideByGrid::decidedFraction() const {
  const auto undetermined = std::count(sides_.begin(), sides_.end(), Side::undetermined);
  return 1 - static_cast<double>(undetermined) / static_cast<double>(sides_.size());
}

}  // namespace cairn::builder
