// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/builder/robot_model.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// What is proved of the spheres of a link, whoever placed them. Metres.
struct LinkCertificate {
  std::string link;           ///< its name
  std::uint32_t spheres = 0;  ///< that stand for meshes, boxes and cylinders
  double sticksOut = 0;       ///< no point of a sphere is farther from the solids of these shapes (see `SolidSource`)
  double leavesOut = 0;       ///< no point of their surfaces is farther from the spheres; 0: the spheres cover them
  bool isChanged = false;     ///< a mesh bounds no solid: `sticksOut` counts in how far its repair or its skin lies off

  /// True when the spheres cover the surfaces: of meshes as the files have them, of cylinders as the prism around.
  bool covers() const { return leavesOut == 0; }
};

/// Proves how far the spheres of one URDF stick out of the shapes of another, and what they leave out, link by link.
/// Links belong together by name. Spheres that both robots have, and boxes and cylinders, are kept shapes: nothing is
/// proved of them, and a link of kept shapes alone is left out of the result.
///
/// Shares the proofs of `certifyBalls` with `fitRobot`, and nothing of its choice of spheres. Fails with one sentence
/// where a link is missing, has no spheres or other shapes, where meshes are not found or read, and with `kCancelled`.
/// Parallel over links; the same result for any number of threads.
Result<std::vector<LinkCertificate>> certifyRobot(const RobotModel& robot, const std::filesystem::path& urdf,
                                                  const RobotModel& spheres,
                                                  const std::map<std::string, std::filesystem::path>& packages,
                                                  const ProgressCallback& progress = {});

}  // namespace cairn::builder
