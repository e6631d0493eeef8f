// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cover/level_cover.h"

namespace cairn::builder {

/// By ball: the points (ascending) that its descendants may hold, because it and all its ancestors do.
using Reach = std::vector<std::vector<std::uint32_t>>;

/// One level of a tree that is grown level by level over the whole surface.
struct CoverLevel {
  std::vector<ChildBall> balls;  ///< depths as the field they were fitted with sees them
  double limit = 0;              ///< stand-off at which they cover everything: no descendant may need more of them
};

/// The balls as children of one parent.
std::vector<ChildBall> levelOf(const SphereSet& balls, std::uint32_t parent);
/// The balls of all parents' children.
SphereSet ballsOf(const std::vector<ChildBall>& level);

/// The reach below no ball at all: every point.
Reach reachOfAll(std::size_t points);
/// What the level's balls reach of what their parents do.
Reach reachOf(const CoverLevel& level, const PointSet& points, const Reach& parents);
/// What the balls of the last of `levels` reach of the points.
Reach reachThrough(std::span<const CoverLevel> levels, const PointSet& points);

/// By parent: the points whose cheapest ball is one of its own, of those it reaches. Every point is in one list.
Reach ownedBy(const CoverLevel& level, const PointSet& points, const Reach& parents);

/// Stand-off at which the level's balls cover the points below their parents' reach.
double standOffOf(const CoverLevel& level, const PointSet& points, const Reach& parents);

/// Raises the levels' limits until they cover these points too.
void widenLimits(std::span<CoverLevel> levels, const PointSet& points);

/// Points spread over those the level's balls hold only at nearly its limit, or not at all: they join the points a
/// level is fitted to, which may have missed what lies between them.
std::vector<Vec3d> nearlyWorst(const CoverLevel& level, const PointSet& points, const Reach& parents);

}  // namespace cairn::builder
