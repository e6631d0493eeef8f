// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "cairn/builder/progress.h"
#include "cairn/builder/robot_model.h"
#include "cairn/builder/view.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Options of `robotView`.
struct RobotViewOptions {
  /// Cover each link by so many, boxes and cylinders too, as `fitRobot` does. Nothing: no spheres but the URDF's own.
  std::optional<std::uint32_t> spheres;
  std::map<std::string, std::filesystem::path> packages;  ///< folders of ROS packages
  std::uint32_t poses = 200;  ///< joint positions in which pairs of links are sought that always meet
  std::uint64_t seed = 1;     ///< of spheres and joint positions
};

/// What a page shows of a robot: for each link its collision shapes as the URDF names them and its spheres, and all
/// joints. Spheres that stand in the URDF have no certified error. Pairs of parent and child, and those that
/// `checkSelfCollision` finds meeting in all poses, are to be ignored.
///
/// Fails with one sentence for meshes that are not found or read, as `fitRobot` does, and with `kCancelled`. The same
/// input and seed give the same bits for any number of threads.
Result<View> robotView(const RobotModel& model, const std::filesystem::path& urdf, const RobotViewOptions& options,
                       const ProgressCallback& progress = {});

}  // namespace cairn::builder
