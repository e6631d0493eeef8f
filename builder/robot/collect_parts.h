// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/robot.h"

namespace cairn::builder {

/// Solids and parts of a robot, still without spheres but those of spheres that are kept. Files are read once for each
/// scale, and surfaces that match (`mirrorMatch`) have one solid.
Result<FittedRobot> collectParts(const RobotModel& model, const std::filesystem::path& urdf,
                                 const RobotOptions& options, const ProgressCallback& progress);

/// Fractions of the whole work: reading and closing meshes, placing spheres.
inline constexpr double kCollected = 0.15;

}  // namespace cairn::builder
