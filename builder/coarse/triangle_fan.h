// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "surface/surface_distance.h"
#include "surface/triangle_packet.h"

namespace cairn::builder {

/// The triangles around a vertex as they would be after a collapse: are they sound, and how far from a source?
class TriangleFan {
 public:
  void clear();
  /// Adds a triangle, as it was and as it would be, the common vertex first. False where it would turn over, or shrink
  /// to nothing.
  bool add(const std::array<Vec3d, 3>& before, const std::array<Vec3d, 3>& after);

  /// The greatest of two kinds of distance: from some points of the fan to the source, and from `points` to the fan.
  /// Empty where it is not below `limit`. Precondition: a triangle.
  std::optional<double> distanceTo(const SurfaceDistance& source, std::span<const Vec3d> points, double limit) const;
  /// The triangle nearest to a point, by the order in which they were added. Precondition: there is one.
  std::size_t nearest(const Vec3d& point) const;

 private:
  double distanceSq(std::size_t triangle, const Vec3d& point) const;

  std::vector<std::array<Vec3d, 3>> triangles_;
  std::vector<TrianglePacket> packets_;
};

/// Keeps so many of the points, spread out: each next one is the farthest from those kept. The order changes.
void keepSpread(std::vector<Vec3d>& points, std::size_t most);

}  // namespace cairn::builder
