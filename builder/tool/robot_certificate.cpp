// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/robot_certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cairn/builder/certify_robot.h"
#include "tool/command.h"
#include "tool/progress_bar.h"
#include "tool/report.h"

namespace cairn::tool {
namespace {

using builder::LinkCertificate;

Json jsonOf(const std::vector<LinkCertificate>& links) {
  Json json = Json::array();
  for (const LinkCertificate& link : links)
    json.push_back({{"link", link.link},
                    {"spheres", link.spheres},
                    {"certified_sticks_out_m", link.sticksOut},
                    {"certified_leaves_out_m", link.leavesOut},
                    {"coverage_proven", link.covers()},
                    {"mesh_changed", link.isChanged}});
  return json;
}

void print(const std::vector<LinkCertificate>& links) {
  std::size_t width = 4;
  for (const LinkCertificate& link : links) width = std::max(width, link.link.size());
  fmt::print("Proved, at most:\n  {:<{}} {:>8} {:>14} {:>14}\n", "link", width, "spheres", "sticks out mm",
             "leaves out mm");
  for (const LinkCertificate& link : links)
    fmt::print("  {:<{}} {:>8} {:>14.3f} {:>14}{}\n", link.link, width, link.spheres, 1e3 * link.sticksOut,
               link.covers() ? "nothing" : fmt::format("{:.3f}", 1e3 * link.leavesOut),
               link.isChanged ? "  (mesh repaired or wrapped)" : "");
}

}  // namespace

int certifyRobotCommand(const std::string& urdf, const std::string& spheres,
                        const std::map<std::string, std::filesystem::path>& packages, const std::string& json,
                        unsigned threads) {
  const auto robot = builder::readUrdf(urdf);
  if (!robot) return refuse(robot.error());
  const auto placed = builder::readUrdf(spheres);
  if (!placed) return refuse(placed.error());
  ProgressBar bar;
  const auto links = builder::certifyRobot(robot.value(), urdf, placed.value(), packages, bar.callback());
  if (!links) return refuse(links.error());
  const Json report = {
      {"robot", urdf}, {"spheres", spheres}, {"links", jsonOf(links.value())}, {"threads", threadsUsed(threads)}};
  if (Status s = writeJson(report, json); !s) return refuse(s.error());
  if (json != "-") print(links.value());
  const auto open = std::ranges::find_if_not(links.value(), &LinkCertificate::covers);
  if (open == links.value().end()) return kDone;
  return refuse(Error{fmt::format("{}: the spheres of link '{}' leave out up to {:.3g} m of its surface", spheres,
                                  open->link, open->leavesOut)});
}

}  // namespace cairn::tool
