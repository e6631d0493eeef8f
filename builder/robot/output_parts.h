// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cairn/builder/robot.h"

namespace cairn::builder {

/// Fails where a link keeps a box or cylinder, which `format` cannot hold.
Status checkSpheresAlone(const RobotOutput& output, std::string_view format);

/// Two links that are not to be checked, and why, as MoveIt's setup assistant says it.
struct IgnoredPair {
  std::uint32_t first = 0, second = 0;
  const char* reason = "";
};
/// Adjacent pairs, then those that always meet.
std::vector<IgnoredPair> ignoredPairs(const RobotOutput& output);

/// The links of `toolFrames`, or all links without children.
std::vector<std::string> toolFramesOf(const RobotOutput& output);

/// Three numbers between spaces, all digits.
std::string spaced(const Vec3d& v);

/// A number that YAML 1.1 and 1.2 take for a float, all digits: with a point, also before an exponent.
std::string yamlNumber(double value);
/// A text in double quotes, as YAML and JSON have it.
std::string yamlText(std::string_view text);
/// `[x, y, z]`.
std::string yamlVector(const Vec3d& v);
/// Lines `LINK:` and, two deeper, `- center: [x, y, z]` and `radius: r`, of all links with spheres.
std::string yamlSpheres(const RobotOutput& output, std::string_view indent);
/// Lines `LINK: [LINK, ...]` of ignored pairs, each under its first link.
std::string yamlIgnored(const RobotOutput& output, std::string_view indent);
/// Names in brackets.
std::string yamlList(const std::vector<std::string>& names);
/// Names of links with spheres.
std::vector<std::string> linksWithSpheres(const RobotOutput& output);
/// Active joints, and their default positions.
std::vector<std::uint32_t> activeJoints(const RobotModel& model);

/// What planners want to know and a URDF does not hold, as cuRobo's template.yml has it; the user's to adapt.
inline constexpr double kMaxAcceleration = 15, kMaxJerk = 500;  // rad/s^2 or m/s^2, and the same per second

}  // namespace cairn::builder
