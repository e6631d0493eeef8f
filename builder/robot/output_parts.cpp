// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/output_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace cairn::builder {

Status checkSpheresAlone(const RobotOutput& output, std::string_view format) {
  for (std::uint32_t l = 0; l < output.model.links.size(); ++l)
    if (output.fitted.keptShape(output.model, l) != nullptr)
      return Error{fmt::format("{}: link '{}' has a box or cylinder, and {} holds spheres alone; add --primitives",
                               output.model.file, output.model.links[l].name, format)};
  return {};
}

std::vector<IgnoredPair> ignoredPairs(const RobotOutput& output) {
  std::vector<IgnoredPair> pairs;
  for (const auto& [a, b] : output.collisions.adjacent) pairs.push_back({a, b, "Adjacent"});
  for (const auto& [a, b] : output.collisions.always()) pairs.push_back({a, b, "Always"});
  return pairs;
}

std::vector<std::string> toolFramesOf(const RobotOutput& output) {
  if (!output.toolFrames.empty()) return output.toolFrames;
  const RobotModel& model = output.model;
  std::vector<char> hasChildren(model.links.size(), 0);
  for (const RobotJoint& joint : model.joints) hasChildren[joint.parent] = 1;
  std::vector<std::string> frames;
  for (std::size_t l = 0; l < model.links.size(); ++l)
    if (hasChildren[l] == 0) frames.push_back(model.links[l].name);
  return frames;
}

std::string spaced(const Vec3d& v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}

std::string yamlNumber(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t exponent = std::min(text.find('e'), text.size());
  if (text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

std::string yamlText(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7F)
      quoted += fmt::format("\\u{:04x}", code);
    else
      quoted += c;
  }
  return quoted + '"';
}

std::string yamlVector(const Vec3d& v) {
  return fmt::format("[{}, {}, {}]", yamlNumber(v.x), yamlNumber(v.y), yamlNumber(v.z));
}

std::string yamlSpheres(const RobotOutput& output, std::string_view indent) {
  std::string text;
  for (std::uint32_t l = 0; l < output.model.links.size(); ++l) {
    const std::vector<Ball> balls = output.fitted.ballsOf(l);
    if (!balls.empty()) text += fmt::format("{}{}:\n", indent, yamlText(output.model.links[l].name));
    for (const Ball& ball : balls)
      text += fmt::format("{0}  - center: {1}\n{0}    radius: {2}\n", indent, yamlVector(ball.center),
                          yamlNumber(ball.radius));
  }
  return text;
}

std::string yamlIgnored(const RobotOutput& output, std::string_view indent) {
  std::map<std::uint32_t, std::vector<std::string>> ignored;
  for (const IgnoredPair& pair : ignoredPairs(output))
    ignored[pair.first].push_back(output.model.links[pair.second].name);
  std::string text;
  for (const auto& [link, others] : ignored)
    text += fmt::format("{}{}: {}\n", indent, yamlText(output.model.links[link].name), yamlList(others));
  return text;
}

std::string yamlList(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + yamlText(name);
  return "[" + text + "]";
}

std::vector<std::string> linksWithSpheres(const RobotOutput& output) {
  std::vector<std::string> names;
  for (std::uint32_t l = 0; l < output.model.links.size(); ++l)
    if (!output.fitted.ballsOf(l).empty()) names.push_back(output.model.links[l].name);
  return names;
}

std::vector<std::uint32_t> activeJoints(const RobotModel& model) {
  std::vector<std::uint32_t> active;
  for (std::uint32_t j = 0; j < model.joints.size(); ++j)
    if (model.joints[j].isActive()) active.push_back(j);
  return active;
}

}  // namespace cairn::builder
