// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/robot.h"
#include "tool/report.h"

namespace cairn::tool {

/// A robot and all that is known of its spheres.
struct RobotReport {
  const builder::RobotModel& model;
  const builder::FittedRobot& fitted;
  const builder::SelfCollisions& collisions;
  const builder::RobotOptions& options;
};

/// The keys of `cairn robot --json`. Lengths are metres.
Json robotJson(const RobotReport& report);

/// The same as tables on standard output; lengths in millimetres.
void printRobot(const RobotReport& report);

}  // namespace cairn::tool
