// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <utility>

#include "cairn/builder/robot_model.h"
#include "robot/xml_document.h"
#include "robot/xml_numbers.h"

namespace cairn::builder {

/// Reads attributes of a document's elements. The first failure is kept; what is read afterwards does not matter.
class UrdfElements {
 public:
  /// Keeps both references.
  UrdfElements(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  /// Notes a failure at a node: file, line, and what is wrong.
  void fail(const pugi::xml_node& at, const std::string& what) {
    if (!failure_) failure_ = Error{fmt::format("{}:{}: {}", file_, lineOf(text_, at.offset_debug()), what)};
  }
  const std::optional<Error>& failure() const { return failure_; }

  /// Numbers of an attribute that has to be there.
  template <std::size_t N>
  std::array<double, N> numbers(const pugi::xml_node& node, const char* name) {
    const pugi::xml_attribute attribute = node.attribute(name);
    const auto found = numbersOf<N>(attribute.value());
    if (!attribute)
      fail(node, fmt::format("<{}> has no attribute {}; add it", node.name(), name));
    else if (!found)
      fail(node, fmt::format("{}=\"{:.80}\" of <{}> is not {} finite number{}; correct it", name, attribute.value(),
                             node.name(), N, N == 1 ? "" : "s"));
    return found.value_or(std::array<double, N>{});
  }
  /// The same, or a default where there is no attribute.
  template <std::size_t N>
  std::array<double, N> numbers(const pugi::xml_node& node, const char* name, const std::array<double, N>& usual) {
    return node.attribute(name) ? numbers<N>(node, name) : usual;
  }
  double number(const pugi::xml_node& node, const char* name) { return numbers<1>(node, name)[0]; }
  double number(const pugi::xml_node& node, const char* name, double usual) {
    return numbers<1>(node, name, {usual})[0];
  }
  Vec3d vector(const pugi::xml_node& node, const char* name) { return toVec(numbers<3>(node, name)); }
  Vec3d vector(const pugi::xml_node& node, const char* name, const Vec3d& usual) {
    return toVec(numbers<3>(node, name, {usual.x, usual.y, usual.z}));
  }
  /// A text that is not empty.
  std::string text(const pugi::xml_node& node, const char* name) {
    const std::string value = node.attribute(name).value();
    if (value.empty()) fail(node, fmt::format("<{}> has no {}; add one", node.name(), name));
    return value;
  }
  /// A length above 0.
  double length(const pugi::xml_node& node, const char* name) {
    const double value = number(node, name);
    if (!failure_ && !(value > 0)) fail(node, fmt::format("{} of <{}> is not above 0; correct it", name, node.name()));
    return value;
  }
  /// The child `<origin>`, or no motion.
  RigidPose origin(const pugi::xml_node& node);

 private:
  static Vec3d toVec(const std::array<double, 3>& n) { return {n[0], n[1], n[2]}; }

  const std::string& text_;
  const std::string& file_;
  std::optional<Error> failure_;
};

/// Roll about x, then pitch about y, then yaw about z, all fixed axes; radians. What URDF calls rpy.
Mat3d rotationOf(const Vec3d& rollPitchYaw);
/// Turn about a unit vector; radians (Rodrigues's formula).
Mat3d rotationAbout(const Vec3d& axis, double angle);

/// The link of an element, without the joint it hangs on.
RobotLink readLink(const pugi::xml_node& node, UrdfElements& elements);

}  // namespace cairn::builder
