// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/robot_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace cairn::tool {
namespace {

using builder::LinkPairCount;
using builder::RobotPart;
using builder::SolidSource;

struct LinkSummary {
  std::size_t spheres = 0, fitted = 0;
  double sticksOut = 0, leavesOut = 0;
  bool covered = true, coversNamed = true;
};

LinkSummary summaryOf(const std::vector<RobotPart>& parts) {
  LinkSummary s;
  for (const RobotPart& part : parts) {
    s.spheres += part.balls.size();
    s.sticksOut = std::max(s.sticksOut, part.sticksOut);
    s.leavesOut = std::max(s.leavesOut, part.leavesOut);
    if (!part.solid) continue;
    ++s.fitted;
    s.covered = s.covered && part.covered;
    s.coversNamed = s.coversNamed && part.coversNamed;
  }
  return s;
}

const char* sourceName(SolidSource source) {
  switch (source) {
    case SolidSource::original:
      return "original";
    case SolidSource::repaired:
      return "repaired";
    case SolidSource::wrapped:
      return "wrapped";
    case SolidSource::box:
      return "box";
    case SolidSource::cylinder:
      return "prism";
  }
  return "";
}

bool isMirrored(const RobotPart& part) {
  return part.signs != Vec3d{1, 1, 1};
}

/// The first link with the same set of spheres, where it is an earlier part.
std::optional<std::string> setOf(const RobotReport& report, const RobotPart& part) {
  for (std::size_t l = 0; l < report.fitted.links.size(); ++l)
    for (const RobotPart& other : report.fitted.links[l]) {
      if (&other == &part) return std::nullopt;
      if (other.solid == part.solid && other.balls.size() == part.balls.size()) return report.model.links[l].name;
    }
  return std::nullopt;
}

/// The file that the URDF names, which a solid found under another name may stand for.
std::string shapeName(const RobotReport& report, std::size_t l, const RobotPart& part) {
  const builder::CollisionShape& shape = report.model.links[l].collisions[part.collision];
  if (shape.kind != builder::CollisionKind::mesh) return report.fitted.solids[*part.solid].name;
  return shape.mesh.substr(shape.mesh.rfind('/') + 1);
}

Json partJson(const RobotReport& report, std::size_t l, const RobotPart& part) {
  Json json = {{"collision", part.collision}, {"spheres", part.balls.size()}};
  if (!part.solid) {
    json["solid"] = "kept";
    return json;
  }
  const builder::RobotSolid& solid = report.fitted.solids[*part.solid];
  json["shape"] = shapeName(report, l, part);
  json["solid"] = sourceName(solid.source);
  if (solid.source == SolidSource::repaired) json["repair"] = solid.changes;
  json["solid_off_original_m"] = solid.offOriginal;
  json["mirrored_by"] = {part.signs.x, part.signs.y, part.signs.z};
  if (const auto link = setOf(report, part)) json["shares_set_of_link"] = *link;
  json["certified_sticks_out_m"] = part.sticksOut;
  json["certified_leaves_out_m"] = part.leavesOut;
  json["coverage_proven"] = part.covered;
  json["original_coverage_proven"] = part.coversNamed;
  return json;
}

Json linkJson(const RobotReport& report, std::size_t l) {
  const std::vector<RobotPart>& parts = report.fitted.links[l];
  const LinkSummary s = summaryOf(parts);
  Json json = {{"link", report.model.links[l].name}, {"spheres", s.spheres}};
  if (s.fitted > 0) {
    json["certified_sticks_out_m"] = s.sticksOut;
    json["certified_leaves_out_m"] = s.leavesOut;
    json["coverage_proven"] = s.covered;
    json["original_coverage_proven"] = s.coversNamed;
  }
  json["collisions"] = Json::array();
  for (const RobotPart& part : parts) json["collisions"].push_back(partJson(report, l, part));
  return json;
}

Json namesJson(const RobotReport& report, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  Json json = Json::array();
  for (const auto& [a, b] : pairs) json.push_back({report.model.links[a].name, report.model.links[b].name});
  return json;
}

void printNote(const RobotReport& report, std::size_t l, const RobotPart& part) {
  if (!part.solid) return;
  const builder::RobotSolid& solid = report.fitted.solids[*part.solid];
  const std::string who = fmt::format("{}: {}", report.model.links[l].name, shapeName(report, l, part));
  if (const auto link = setOf(report, part)) {
    fmt::print("{} has the spheres of link '{}'{}\n", who, *link, isMirrored(part) ? ", mirrored" : "");
  } else if (solid.source == SolidSource::repaired) {
    fmt::print("{} was repaired ({}); the proof is about the repaired mesh\n", who, solid.changes);
  } else if (solid.source == SolidSource::wrapped) {
    const char* const inner = part.coversNamed ? "; triangles of the file are covered too"
                              : part.covered   ? "; triangles of the file that lie inside it are not all covered"
                                               : "";
    fmt::print("{} was wrapped in a closed skin, which is up to {:.3f} mm off and counted in{}\n", who,
               1000 * solid.offOriginal, inner);
  }
}

void printCollisions(const RobotReport& report) {
  const builder::SelfCollisions& c = report.collisions;
  if (c.poses == 0) return;
  fmt::print("Self-collision at {} positions, {} pairs of links, {} adjacent ones left out:\n", c.poses, c.pairsTried,
             c.adjacent.size());
  const auto count = [&](auto member) {
    return std::count_if(c.touching.begin(), c.touching.end(), [&](const LinkPairCount& p) { return p.*member > 0; });
  };
  fmt::print("  pairs that touch by spheres: {}, by meshes: {}; falsely: {}, missed: {}\n",
             count(&LinkPairCount::spheres), count(&LinkPairCount::meshes), count(&LinkPairCount::falsely),
             count(&LinkPairCount::missed));
  for (const LinkPairCount& p : c.touching) {
    const std::string &a = report.model.links[p.first].name, &b = report.model.links[p.second].name;
    if (p.meshes == c.poses)
      fmt::print("  {} and {} meet at all positions: ignored\n", a, b);
    else if (p.spheres == c.poses)
      fmt::print(
          "  {} and {} touch at all positions by spheres, at {} by meshes: not ignored; give them more spheres\n", a, b,
          p.meshes);
    else if (p.falsely > 0)
      fmt::print("  {} and {} touch falsely at {} positions\n", a, b, p.falsely);
    if (p.missed > 0) fmt::print("  {} and {} meet at {} positions where no sphere touches\n", a, b, p.missed);
  }
}

}  // namespace

Json robotJson(const RobotReport& report) {
  Json json = {{"robot", report.model.name},
               {"objective", builder::objectiveName(report.options.objective)},
               {"seed", report.options.seed}};
  std::size_t total = 0;
  Json links = Json::array();
  for (std::size_t l = 0; l < report.fitted.links.size(); ++l) {
    total += summaryOf(report.fitted.links[l]).spheres;
    links.push_back(linkJson(report, l));
  }
  json["spheres"] = total;
  json["links"] = std::move(links);
  Json pairs = Json::array();
  for (const LinkPairCount& p : report.collisions.touching)
    pairs.push_back({{"links", {report.model.links[p.first].name, report.model.links[p.second].name}},
                     {"spheres_touch_positions", p.spheres},
                     {"meshes_meet_positions", p.meshes},
                     {"falsely_positions", p.falsely},
                     {"missed_positions", p.missed}});
  json["self_collision"] = {{"positions", report.collisions.poses},
                            {"pairs_tried", report.collisions.pairsTried},
                            {"adjacent", namesJson(report, report.collisions.adjacent)},
                            {"always", namesJson(report, report.collisions.always())},
                            {"pairs", std::move(pairs)}};
  return json;
}

void printRobot(const RobotReport& report) {
  fmt::print("{:<28} {:>8} {:>14} {:>14}  {}\n", "link", "spheres", "sticks out mm", "leaves out mm", "covered");
  for (std::size_t l = 0; l < report.fitted.links.size(); ++l) {
    const std::vector<RobotPart>& parts = report.fitted.links[l];
    const LinkSummary s = summaryOf(parts);
    const std::string& name = report.model.links[l].name;
    if (s.fitted == 0)
      fmt::print("{:<28} {:>8} {:>14} {:>14}  {}\n", name, s.spheres, "-", "-",
                 parts.empty() ? "no collision geometry" : "kept");
    else
      fmt::print("{:<28} {:>8} {:>14.3f} {:>14.3f}  {}\n", name, s.spheres, 1000 * s.sticksOut, 1000 * s.leavesOut,
                 s.covered ? "proved" : "no");
  }
  for (std::size_t l = 0; l < report.fitted.links.size(); ++l)
    for (const RobotPart& part : report.fitted.links[l]) printNote(report, l, part);
  printCollisions(report);
}

}  // namespace cairn::tool
