// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

#include "cairn/core/atomic_file.h"
#include "robot/joint_types.h"
#include "robot/urdf_element.h"

namespace cairn::builder {
namespace {

using Names = std::map<std::string, std::uint32_t, std::less<>>;

class UrdfReader {
 public:
  UrdfReader(std::string text, std::string file) {
    model_.text = std::move(text);
    model_.file = std::move(file);
  }

  Result<RobotModel> read() {
    pugi::xml_document document;
    if (Status s = parseXml(model_.text, model_.file, document); !s) return s.error();
    const pugi::xml_node robot = document.document_element();
    if (std::string_view(robot.name()) != "robot")
      return refused(fmt::format("it is no URDF: its outermost element is <{:.40}>, not <robot>", robot.name()));
    for (const pugi::xml_node& child : robot.children())
      if (std::string_view(child.name()).starts_with("xacro:"))
        return refused("it holds xacro's macros; run xacro first");
    model_.name = elements_.text(robot, "name");
    for (const pugi::xml_node& link : robot.children("link")) addLink(link);
    for (const pugi::xml_node& joint : robot.children("joint")) addJoint(joint);
    for (const pugi::xml_node& joint : robot.children("joint")) addMimic(joint);
    if (elements_.failure()) return *elements_.failure();
    if (Status s = orderLinks(); !s) return s.error();
    if (Status s = checkMimics(); !s) return s.error();
    return std::move(model_);
  }

 private:
  Error refused(const std::string& why) const { return Error{model_.file + ": " + why}; }

  void addLink(const pugi::xml_node& node) {
    model_.links.push_back(readLink(node, elements_));
    const std::string& name = model_.links.back().name;
    if (!links_.emplace(name, static_cast<std::uint32_t>(model_.links.size() - 1)).second)
      elements_.fail(node, fmt::format("there are two links '{}'; rename one", name));
  }

  std::uint32_t linkOf(const pugi::xml_node& joint, const char* which) {
    const pugi::xml_node node = joint.child(which);
    const std::string name = node.attribute("link").value();
    const auto found = links_.find(name);
    if (found != links_.end()) return found->second;
    elements_.fail(joint, fmt::format("the {} of joint '{}' is link '{}', which there is not; correct it", which,
                                      joint.attribute("name").value(), name));
    return 0;
  }

  void addJoint(const pugi::xml_node& node) {
    RobotJoint joint;
    joint.name = elements_.text(node, "name");
    const std::string type = elements_.text(node, "type");
    const auto* const known =
        std::find_if(std::begin(kJointTypes), std::end(kJointTypes), [&](const auto& t) { return t.first == type; });
    if (known == std::end(kJointTypes))
      return elements_.fail(node, fmt::format("joint '{}' has the unknown type '{:.40}'", joint.name, type));
    joint.type = known->second;
    joint.parent = linkOf(node, "parent");
    joint.child = linkOf(node, "child");
    joint.origin = elements_.origin(node);
    if (const pugi::xml_node axis = node.child("axis")) joint.axis = elements_.vector(axis, "xyz");
    const bool turnsOrSlides = joint.type != JointType::fixed && joint.type != JointType::floating;
    if (turnsOrSlides && lengthSq(joint.axis) == 0)
      elements_.fail(node, fmt::format("the axis of joint '{}' has no direction; correct it", joint.name));
    else if (turnsOrSlides)
      joint.axis = normalized(joint.axis);
    addLimits(node, joint);
    if (const pugi::xml_node dynamics = node.child("dynamics")) {
      joint.damping = elements_.number(dynamics, "damping", 0);
      joint.friction = elements_.number(dynamics, "friction", 0);
    }
    if (!joints_.emplace(joint.name, static_cast<std::uint32_t>(model_.joints.size())).second)
      elements_.fail(node, fmt::format("there are two joints '{}'; rename one", joint.name));
    model_.joints.push_back(joint);
  }

  void addLimits(const pugi::xml_node& node, RobotJoint& joint) {
    if (joint.type == JointType::continuous) {
      joint.lower = -std::numbers::pi;
      joint.upper = std::numbers::pi;
    }
    if (joint.type != JointType::revolute && joint.type != JointType::prismatic) return;
    const pugi::xml_node limit = node.child("limit");
    if (!limit) return elements_.fail(node, fmt::format("joint '{}' has no <limit>; add one", joint.name));
    joint.lower = elements_.number(limit, "lower", 0);
    joint.upper = elements_.number(limit, "upper", 0);
    if (joint.lower > joint.upper)
      elements_.fail(limit, fmt::format("the lower limit of joint '{}' is above its upper one", joint.name));
  }

  void addMimic(const pugi::xml_node& node) {
    const pugi::xml_node mimic = node.child("mimic");
    const auto joint = joints_.find(std::string_view(node.attribute("name").value()));
    if (!mimic || joint == joints_.end()) return;
    const std::string name = elements_.text(mimic, "joint");
    const auto followed = joints_.find(name);
    if (followed == joints_.end())
      return elements_.fail(mimic,
                            fmt::format("joint '{}' follows joint '{}', which there is not", joint->first, name));
    model_.joints[joint->second].mimic =
        JointMimic{followed->second, elements_.number(mimic, "multiplier", 1), elements_.number(mimic, "offset", 0)};
  }

  /// Links from the root outwards. What a walk from the root does not reach hangs in a ring.
  Status orderLinks() {
    if (model_.links.empty()) return refused("it has no links; add some");
    std::vector<std::vector<std::uint32_t>> children(model_.links.size());
    for (std::uint32_t j = 0; j < model_.joints.size(); ++j) {
      const RobotJoint& joint = model_.joints[j];
      RobotLink& child = model_.links[joint.child];
      if (child.joint)
        return refused(fmt::format("link '{}' is the child of joints '{}' and '{}'; a URDF is a tree, remove one",
                                   child.name, model_.joints[*child.joint].name, joint.name));
      child.joint = j;
      children[joint.parent].push_back(joint.child);
    }
    std::vector<std::uint32_t>& order = model_.parentsFirst;
    for (std::uint32_t l = 0; l < model_.links.size(); ++l)
      if (!model_.links[l].joint) order.push_back(l);
    if (order.size() > 1)
      return refused(fmt::format("links '{}' and '{}' hang on no joint; a URDF has one root, join them",
                                 model_.links[order[0]].name, model_.links[order[1]].name));
    for (std::size_t i = 0; i < order.size(); ++i)
      for (const std::uint32_t child : children[order[i]]) order.push_back(child);
    if (order.size() < model_.links.size()) return refused(ringSentence());
    model_.root = order.front();
    return {};
  }

  std::string ringSentence() const {
    std::vector<char> reached(model_.links.size(), 0);
    for (const std::uint32_t l : model_.parentsFirst) reached[l] = 1;
    const auto l = static_cast<std::size_t>(std::find(reached.begin(), reached.end(), 0) - reached.begin());
    return fmt::format("link '{}' hangs in a ring of joints (joint '{}'); a URDF is a tree, remove a joint",
                       model_.links[l].name, model_.joints[*model_.links[l].joint].name);
  }

  Status checkMimics() const {
    for (const RobotJoint& joint : model_.joints)
      if (joint.mimic && model_.joints[joint.mimic->joint].mimic)
        return refused(fmt::format("joint '{}' follows joint '{}', which follows another; let both follow the first",
                                   joint.name, model_.joints[joint.mimic->joint].name));
    return {};
  }

  RobotModel model_;
  UrdfElements elements_{model_.text, model_.file};
  Names links_, joints_;
};

}  // namespace

Result<RobotModel> readUrdf(const std::filesystem::path& path) {
  const std::string file = path.filename().string();
  std::error_code none;
  if (std::filesystem::file_size(path, none) > kMaxUrdfBytes && !none)
    return Error{fmt::format("{}: it is longer than {} MiB, which no URDF is", file, kMaxUrdfBytes >> 20)};
  const Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes) return bytes.error();
  const auto* const characters = reinterpret_cast<const char*>(bytes.value().data());
  return UrdfReader({characters, bytes.value().size()}, file).read();
}

}  // namespace cairn::builder
