// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "robot/output_parts.h"

namespace cairn::builder {
namespace {

std::string zeros(const std::vector<std::string>& names, std::string_view indent) {
  std::string text;
  for (const std::string& name : names) text += fmt::format("{}{}: 0.0\n", indent, yamlText(name));
  return text;
}

/// An empty mapping where there is no line: a key without a value would be null.
std::string mapping(std::string_view key, const std::string& lines) {
  return lines.empty() ? fmt::format("{}: {{}}\n", key) : fmt::format("{}:\n{}", key, lines);
}

std::vector<std::string> namesOf(const RobotModel& model, const std::vector<std::uint32_t>& joints) {
  std::vector<std::string> names;
  for (const std::uint32_t j : joints) names.push_back(model.joints[j].name);
  return names;
}

std::string repeated(const std::string& value, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + value;
  return "[" + text + "]";
}

}  // namespace

// Keys as cuRobo's content/configs/robot/template.yml has them. The spheres cover by proof, so no buffer is added.
Result<std::string> robotCuroboText(const RobotOutput& output) {
  if (Status s = checkSpheresAlone(output, "cuRobo's configuration"); !s) return s.error();
  const RobotModel& model = output.model;
  const std::vector<std::string> tools = toolFramesOf(output), links = linksWithSpheres(output);
  const std::vector<std::uint32_t> joints = activeJoints(model);
  std::string text =
      "# The robot and its collision spheres for cuRobo. Limits of acceleration and jerk are those of\n"
      "# cuRobo's template: a URDF has none. Adapt them, urdf_path, ee_link and retract_config.\n"
      "robot_cfg:\n  kinematics:\n";
  text += fmt::format("    urdf_path: {}\n    asset_root_path: \"\"\n", yamlText(output.urdf));
  text += fmt::format("    base_link: {}\n    ee_link: {}\n", yamlText(model.links[model.root].name),
                      yamlText(tools.front()));
  text += fmt::format("    link_names: {}\n", tools.size() > 1 ? yamlList(tools) : "null");
  text += "    lock_joints: null\n    extra_links: null\n";
  text += fmt::format("    collision_link_names: {}\n", yamlList(links));
  text += mapping("    collision_spheres", yamlSpheres(output, "      "));
  text += "    collision_sphere_buffer: 0.0\n    extra_collision_spheres: {}\n";
  text += mapping("    self_collision_ignore", yamlIgnored(output, "      "));
  text += mapping("    self_collision_buffer", zeros(links, "      "));
  text += "    use_global_cumul: true\n    mesh_link_names: null\n    cspace:\n";
  text += fmt::format("      joint_names: {}\n", yamlList(namesOf(model, joints)));
  std::string retract;
  for (const std::uint32_t j : joints) retract += (retract.empty() ? "" : ", ") + yamlNumber(model.defaultPosition(j));
  text += fmt::format("      retract_config: [{}]\n", retract);
  for (const char* weight : {"null_space_weight", "cspace_distance_weight"})
    text += fmt::format("      {}: {}\n", weight, repeated("1.0", joints.size()));
  text += fmt::format("      max_jerk: {}\n      max_acceleration: {}\n", yamlNumber(kMaxJerk),
                      yamlNumber(kMaxAcceleration));
  return text;
}

// Sections as NVIDIA Isaac's page "Extended Robot Description Format (XRDF)" names them; `buffer_distance` is written,
// because cuRobo's convert_xrdf_to_curobo insists on it.
Result<std::string> robotXrdfText(const RobotOutput& output) {
  if (Status s = checkSpheresAlone(output, "an XRDF"); !s) return s.error();
  const RobotModel& model = output.model;
  const std::vector<std::string> links = linksWithSpheres(output);
  const std::vector<std::uint32_t> joints = activeJoints(model);
  std::string positions;
  for (const std::uint32_t j : joints)
    positions += fmt::format("  {}: {}\n", yamlText(model.joints[j].name), yamlNumber(model.defaultPosition(j)));
  std::string text =
      "# Spheres cover the collision meshes of the URDF. Limits of acceleration and jerk are cuRobo's\n"
      "# usual ones: a URDF has none. Adapt them, default_joint_positions and tool_frames.\n"
      "format: xrdf\nformat_version: 1.0\n\n";
  text += mapping("default_joint_positions", positions);
  text += fmt::format("\ncspace:\n  joint_names: {}\n", yamlList(namesOf(model, joints)));
  text +=
      fmt::format("  acceleration_limits: {}\n  jerk_limits: {}\n",
                  repeated(yamlNumber(kMaxAcceleration), joints.size()), repeated(yamlNumber(kMaxJerk), joints.size()));
  text += fmt::format("\ntool_frames: {}\n", yamlList(toolFramesOf(output)));
  const std::string buffers = mapping("  buffer_distance", zeros(links, "    "));
  text += "\ncollision:\n  geometry: collision_spheres\n" + buffers;
  text += "\nself_collision:\n  geometry: collision_spheres\n" + buffers;
  text += mapping("  ignore", yamlIgnored(output, "    "));
  text += "\ngeometry:\n  collision_spheres:\n" + mapping("    spheres", yamlSpheres(output, "      "));
  return text;
}

}  // namespace cairn::builder
