// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <string_view>

#include "robot/output_parts.h"
#include "robot/xml_document.h"

namespace cairn::builder {
namespace {

void addSphere(pugi::xml_node collision, const Ball& ball, const std::string& name) {
  if (!name.empty()) collision.append_attribute("name") = name.c_str();
  pugi::xml_node origin = collision.append_child("origin");
  origin.append_attribute("xyz") = spaced(ball.center).c_str();
  origin.append_attribute("rpy") = "0 0 0";
  collision.append_child("geometry").append_child("sphere").append_attribute("radius") =
      fmt::format("{}", ball.radius).c_str();
}

/// Writes one `<collision>` a sphere in place of `old`, each on a line that is indented alike.
void replaceCollision(pugi::xml_node old, const std::vector<Ball>& balls) {
  pugi::xml_node link = old.parent();
  const pugi::xml_node before = old.previous_sibling();
  const bool isIndented = before.type() == pugi::node_pcdata &&
                          std::string_view(before.value()).find_first_not_of(" \t\r\n") == std::string_view::npos;
  const std::string name = old.attribute("name").value();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (i > 0 && isIndented) link.insert_copy_before(before, old);
    addSphere(link.insert_child_before("collision", old), balls[i],
              name.empty() ? name : fmt::format("{}_{}", name, i));
  }
  link.remove_child(old);
}

}  // namespace

Result<std::string> robotUrdfText(const RobotOutput& output) {
  pugi::xml_document document;
  if (Status s = parseXml(output.model.text, output.model.file, document); !s) return s.error();
  std::size_t l = 0;
  for (pugi::xml_node link : document.document_element().children("link")) {
    std::vector<pugi::xml_node> collisions;
    for (const pugi::xml_node collision : link.children("collision")) collisions.push_back(collision);
    for (const RobotPart& part : output.fitted.links[l++])
      if (part.solid) replaceCollision(collisions[part.collision], part.balls);
  }
  return xmlText(document, output.model.text);
}

}  // namespace cairn::builder
