// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/robot.h"

namespace cairn::builder {

/// Whether one budget is given, in range, for links there are.
Status checkBudget(const RobotModel& model, const RobotBudget& budget);

/// Shares the budget out, places the spheres of all solids and puts them into their parts.
Status fitParts(const RobotModel& model, const RobotOptions& options, const ProgressCallback& progress,
                FittedRobot& fitted);

}  // namespace cairn::builder
