// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "robot/output_parts.h"
#include "robot/xml_document.h"

namespace cairn::builder {
namespace {

/// w, x, y, z of a rotation, by the largest of the four (Shepperd 1978).
std::array<double, 4> quaternionOf(const Mat3d& m) {
  const double trace = m(0, 0) + m(1, 1) + m(2, 2);
  if (trace > 0) {
    const double s = 2 * std::sqrt(trace + 1);
    return {0.25 * s, (m(2, 1) - m(1, 2)) / s, (m(0, 2) - m(2, 0)) / s, (m(1, 0) - m(0, 1)) / s};
  }
  int i = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (m(axis, axis) > m(i, i)) i = axis;
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const double s = 2 * std::sqrt(std::max(0.0, 1 + m(i, i) - m(j, j) - m(k, k)));
  std::array<double, 4> q{};
  q[0] = (m(k, j) - m(j, k)) / s;
  q[1 + i] = 0.25 * s;
  q[1 + j] = (m(j, i) + m(i, j)) / s;
  q[1 + k] = (m(k, i) + m(i, k)) / s;
  return q;
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name) = value.c_str();
}

void place(pugi::xml_node node, const RigidPose& pose) {
  set(node, "pos", spaced(pose.translation));
  const auto [w, x, y, z] = quaternionOf(pose.rotation);
  if (w != 1) set(node, "quat", fmt::format("{} {} {} {}", w, x, y, z));
}

/// Elements and attributes as MuJoCo's "XML Reference" has them. All names are those of the URDF.
class MjcfWriter {
 public:
  explicit MjcfWriter(const RobotOutput& output) : output_(output), model_(output.model) {}

  Result<std::string> write() {
    pugi::xml_node mujoco = document_.append_child("mujoco");
    set(mujoco, "model", model_.name);
    mujoco.append_child("compiler").append_attribute("angle") = "radian";
    pugi::xml_node world = mujoco.append_child("worldbody");
    bodies_.resize(model_.links.size());
    for (const std::uint32_t l : model_.parentsFirst)
      if (Status s = addBody(l, world); !s) return s.error();
    addContacts(mujoco);
    addMimics(mujoco);
    return indentedXmlText(document_);
  }

 private:
  Error refused(const std::string& why) const { return Error{fmt::format("{}: {}", model_.file, why)}; }

  Status addBody(std::uint32_t l, pugi::xml_node world) {
    const RobotLink& link = model_.links[l];
    if (!link.joint) {
      const bool isWorld = link.name == "world";  // a name that MuJoCo keeps for its own
      bodies_[l] = isWorld ? world : world.append_child("body");
      if (!isWorld) set(bodies_[l], "name", link.name);
    } else {
      const RobotJoint& joint = model_.joints[*link.joint];
      bodies_[l] = bodies_[joint.parent].append_child("body");
      set(bodies_[l], "name", link.name);
      place(bodies_[l], joint.origin);
      if (Status s = addJoint(joint, bodies_[joint.parent] == world, bodies_[l]); !s) return s;
    }
    if (link.inertia && link.inertia->mass > 0 && bodies_[l] != world) addInertia(*link.inertia, bodies_[l]);
    addGeometry(l);
    return {};
  }

  Status addJoint(const RobotJoint& joint, bool hangsOnWorld, pugi::xml_node body) {
    if (joint.type == JointType::fixed) return {};
    if (!hasMass(joint.child))
      return refused(
          fmt::format("link '{}' moves and has neither mass nor collision geometry, which MuJoCo refuses; "
                      "give it an <inertial>",
                      model_.links[joint.child].name));
    if (joint.type == JointType::floating && hangsOnWorld) {
      set(body.append_child("freejoint"), "name", joint.name);
      return {};
    }
    if (joint.type == JointType::floating || joint.type == JointType::planar)
      return refused(
          fmt::format("joint '{}' is planar or floating, which an MJCF has at a root 'world' at most "
                      "(floating); leave out --mjcf",
                      joint.name));
    pugi::xml_node node = body.append_child("joint");
    set(node, "name", joint.name);
    set(node, "type", joint.type == JointType::prismatic ? "slide" : "hinge");
    set(node, "axis", spaced(joint.axis));
    const bool isLimited = joint.type != JointType::continuous;
    set(node, "limited", isLimited ? "true" : "false");
    if (isLimited) set(node, "range", fmt::format("{} {}", joint.lower, joint.upper));
    if (joint.damping > 0) set(node, "damping", fmt::format("{}", joint.damping));
    if (joint.friction > 0) set(node, "frictionloss", fmt::format("{}", joint.friction));
    return {};
  }

  /// Whether a link, or one that is fixed to it, has mass or geometry that gets mass.
  bool hasMass(std::uint32_t link) const {
    std::vector<std::uint32_t> fixedTogether{link};
    for (std::size_t i = 0; i < fixedTogether.size(); ++i) {
      const std::uint32_t l = fixedTogether[i];
      const auto& inertia = model_.links[l].inertia;
      if ((inertia && inertia->mass > 0) || !output_.fitted.links[l].empty()) return true;
      for (const RobotJoint& joint : model_.joints)
        if (joint.parent == l && joint.type == JointType::fixed) fixedTogether.push_back(joint.child);
    }
    return false;
  }

  static void addInertia(const LinkInertia& inertia, pugi::xml_node body) {
    const Mat3d& turn = inertia.origin.rotation;
    const Mat3d m = turn * inertia.inertia * transpose(turn);
    pugi::xml_node node = body.append_child("inertial");
    set(node, "pos", spaced(inertia.origin.translation));
    set(node, "mass", fmt::format("{}", inertia.mass));
    set(node, "fullinertia", fmt::format("{} {} {} {} {} {}", m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)));
  }

  void addGeometry(std::uint32_t l) {
    for (const RobotPart& part : output_.fitted.links[l]) {
      for (const Ball& ball : part.balls) {
        pugi::xml_node geom = bodies_[l].append_child("geom");
        set(geom, "type", "sphere");
        set(geom, "size", fmt::format("{}", ball.radius));
        set(geom, "pos", spaced(ball.center));
      }
      if (part.balls.empty()) addKept(model_.links[l].collisions[part.collision], bodies_[l]);
    }
  }

  /// MuJoCo's sizes are halves of edges and of a cylinder's length.
  static void addKept(const CollisionShape& shape, pugi::xml_node body) {
    pugi::xml_node geom = body.append_child("geom");
    const bool isBox = shape.kind == CollisionKind::box;
    set(geom, "type", isBox ? "box" : "cylinder");
    set(geom, "size", isBox ? spaced(shape.size * 0.5) : fmt::format("{} {}", shape.size.x, 0.5 * shape.size.y));
    place(geom, shape.origin);
  }

  void addContacts(pugi::xml_node mujoco) {
    const std::vector<IgnoredPair> pairs = ignoredPairs(output_);
    if (pairs.empty()) return;
    pugi::xml_node contact = mujoco.append_child("contact");
    for (const IgnoredPair& pair : pairs) {
      pugi::xml_node exclude = contact.append_child("exclude");
      set(exclude, "body1", model_.links[pair.first].name);
      set(exclude, "body2", model_.links[pair.second].name);
    }
  }

  void addMimics(pugi::xml_node mujoco) {
    pugi::xml_node equality;
    for (const RobotJoint& joint : model_.joints) {
      if (!joint.mimic || joint.type == JointType::fixed) continue;
      if (!equality) equality = mujoco.append_child("equality");
      pugi::xml_node node = equality.append_child("joint");
      set(node, "joint1", joint.name);
      set(node, "joint2", model_.joints[joint.mimic->joint].name);
      set(node, "polycoef", fmt::format("{} {} 0 0 0", joint.mimic->offset, joint.mimic->multiplier));
    }
  }

  const RobotOutput& output_;
  const RobotModel& model_;
  pugi::xml_document document_;
  std::vector<pugi::xml_node> bodies_;
};

}  // namespace

Result<std::string> robotMjcfText(const RobotOutput& output) {
  return MjcfWriter(output).write();
}

}  // namespace cairn::builder
