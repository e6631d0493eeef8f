// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "cairn/builder/robot.h"
#include "robot/collect_parts.h"
#include "robot/fit_parts.h"

namespace cairn::builder {

std::vector<Ball> FittedRobot::ballsOf(std::uint32_t link) const {
  std::vector<Ball> balls;
  for (const RobotPart& part : links[link]) balls.insert(balls.end(), part.balls.begin(), part.balls.end());
  return balls;
}

const RobotPart* FittedRobot::keptShape(const RobotModel& model, std::uint32_t link) const {
  const auto isShape = [&](const RobotPart& part) {
    return !part.solid && model.links[link].collisions[part.collision].kind != CollisionKind::sphere;
  };
  const auto found = std::find_if(links[link].begin(), links[link].end(), isShape);
  return found == links[link].end() ? nullptr : &*found;
}

Result<FittedRobot> fitRobot(const RobotModel& model, const std::filesystem::path& urdf, const RobotOptions& options,
                             const ProgressCallback& progress) {
  if (Status s = checkBudget(model, options.budget); !s) return s.error();
  Result<FittedRobot> fitted = collectParts(model, urdf, options, progress);
  if (!fitted) return fitted;
  if (Status s = fitParts(model, options, progress, fitted.value()); !s) return s.error();
  return fitted;
}

}  // namespace cairn::builder
