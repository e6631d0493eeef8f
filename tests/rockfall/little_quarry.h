// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace cairn::test {

/// Writes the data of an experiment laid out as Authume's, made up: a slope of blue ground that leans down along x at
/// 30 degrees, then flat gray ground, a patch of red ground on it; two places to fall from on either profile; four
/// orientations; boxes for blocks; 6 measured stops and 4 published runs on P1. y is up.
void writeLittleQuarry(const std::filesystem::path& folder);

inline constexpr double kLittleSlopeEndsX = 20, kLittleGroundEndsX = 60, kLittleHalfWidth = 10;
inline constexpr double kLittleRedFromX = 50;
inline constexpr double kLittleDropX = 2, kLittleDropHeight = 1.5;  // m, of the centre above the ground
/// The height of the ground, in the data's y.
double littleHeight(double x);

}  // namespace cairn::test
