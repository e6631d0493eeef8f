// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cover/level_cover.h"

namespace cairn::builder {

/// By ball: the points (ascending) that its descendants may hold, because the ball and all its ancestors hold them.
using Reach = std::vector<std::vector<std::uint32_t>>;

/// One level of a tree that is grown level by level over the whole surface.
struct CoverLevel {
  std::vector<ChildBall> balls;  ///< depths are those of the field they were fitted in
  double limit = 0;              ///< stand-off at which they cover everything; no descendant may need more of them
};

/// Returns the balls as children of one parent.
std::vector<ChildBall> levelOf(const SphereSet& balls, std::uint32_t parent);
/// Returns the balls of all children.
SphereSet ballsOf(const std::vector<ChildBall>& level);

/// Returns the reach of the root's parent: every point.
Reach reachOfAll(std::size_t points);
/// Returns the reach of the level's balls within the reach of their parents.
Reach reachOf(const CoverLevel& level, const PointSet& points, const Reach& parents);
/// Returns the reach of the balls of the last of `levels`.
Reach reachThrough(std::span<const CoverLevel> levels, const PointSet& points);

/// By parent: the points within its reach whose cheapest ball is one of its own. Every point is in one list.
Reach ownedBy(const CoverLevel& level, const PointSet& points, const Reach& parents);

/// Returns the stand-off at which the level's balls cover the points, each within its parents' reach.
double standOffOf(const CoverLevel& level, const PointSet& points, const Reach& parents);

/// Raises the levels' limits until the levels cover these points too.
void widenLimits(std::span<CoverLevel> levels, const PointSet& points);

/// Returns points spread over those that the level's balls hold only at nearly its limit, or not at all. They join the
/// points that a level is fitted to, which may be too sparse there.
std::vector<Vec3d> nearlyWorst(const CoverLevel& level, const PointSet& points, const Reach& parents);

}  // namespace cairn::builder
