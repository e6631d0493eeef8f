// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "robot/output_parts.h"
#include "robot/xml_document.h"

namespace cairn::builder {

// Elements and attributes as srdfdom's model.cpp reads them (loadLinkSphereApproximations, loadCollisionPairs).
Result<std::string> robotSrdfText(const RobotOutput& output) {
  if (Status s = checkSpheresAlone(output, "an SRDF"); !s) return s.error();
  pugi::xml_document document;
  document.append_child(pugi::node_declaration).append_attribute("version") = "1.0";
  pugi::xml_node robot = document.append_child("robot");
  robot.append_attribute("name") = output.model.name.c_str();
  for (std::uint32_t l = 0; l < output.model.links.size(); ++l) {
    const std::vector<Ball> balls = output.fitted.ballsOf(l);
    if (balls.empty()) continue;
    pugi::xml_node link = robot.append_child("link_sphere_approximation");
    link.append_attribute("link") = output.model.links[l].name.c_str();
    for (const Ball& ball : balls) {
      pugi::xml_node sphere = link.append_child("sphere");
      sphere.append_attribute("center") = spaced(ball.center).c_str();
      sphere.append_attribute("radius") = fmt::format("{}", ball.radius).c_str();
    }
  }
  for (const IgnoredPair& pair : ignoredPairs(output)) {
    pugi::xml_node node = robot.append_child("disable_collisions");
    node.append_attribute("link1") = output.model.links[pair.first].name.c_str();
    node.append_attribute("link2") = output.model.links[pair.second].name.c_str();
    node.append_attribute("reason") = pair.reason;
  }
  return indentedXmlText(document);
}

}  // namespace cairn::builder
