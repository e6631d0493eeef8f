// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/report.h"

#include <fmt/format.h>

#include <cstdio>

#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "import/sha256.h"

namespace cairn::tool {

Json levelsJson(const std::vector<builder::LevelFit>& fits, builder::Sampling sampling) {
  Json levels = Json::array();
  for (const builder::LevelFit& fit : fits) {
    Json level = {{"level", fit.level},
                  {"spheres", fit.spheres},
                  {"certified_max_fraction", fit.certifiedMaxFraction},
                  {"certified_rms_fraction", fit.certifiedRmsFraction}};
    if (sampling == builder::Sampling::full) {
      level["sampled_max_fraction"] = fit.sampledMaxFraction;
      level["sampled_rms_fraction"] = fit.sampledRmsFraction;
      level["uncovered_area_fraction"] = fit.uncoveredAreaFraction;
      level["wasted_volume_fraction"] = fit.wastedVolumeFraction;
    }
    level["coverage_proven"] = fit.coverageProven;
    level["reachable_proven"] = fit.reachableProven;
    levels.push_back(std::move(level));
  }
  return levels;
}

Json buildInfoJson(const SphereTree& tree) {
  const BuildInfo& info = tree.info();
  return {{"mesh", info.meshName},   {"method", info.method}, {"branching", info.branching}, {"depth", info.depth},
          {"samples", info.samples}, {"seed", info.seed},     {"nodes", tree.nodeCount()}};
}

std::string treeSha256(const SphereTree& tree) {
  return builder::sha256Hex(encodeTree(tree));
}

Status writeJson(const Json& json, const std::string& path) {
  if (path.empty()) return {};
  // A file name may hold bytes that are not UTF-8; they are replaced, not fatal.
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (path != "-") return writeFileAtomically(path, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    return Error{"standard output cannot be written; check where it leads"};
  return {};
}

void printLevels(const std::vector<builder::LevelFit>& fits, builder::Sampling sampling) {
  const bool full = sampling == builder::Sampling::full;
  fmt::print("level  spheres  protrusion, certified  ");
  if (full) fmt::print("sampled          uncovered  wasted  ");
  fmt::print("cover\n                max %    rms %        ");
  if (full) fmt::print("  max %    rms %    area %     volume %  ");
  fmt::print("\n");
  for (const builder::LevelFit& fit : fits) {
    fmt::print("{:5}  {:7} {:8.4f} {:8.4f}        ", fit.level, fit.spheres, 100 * fit.certifiedMaxFraction,
               100 * fit.certifiedRmsFraction);
    if (full)
      fmt::print("{:7.4f}  {:7.4f}  {:7.4f}  {:9.2f}   ", 100 * fit.sampledMaxFraction, 100 * fit.sampledRmsFraction,
                 100 * fit.uncoveredAreaFraction, 100 * fit.wastedVolumeFraction);
    fmt::print("{}\n", fit.reachableProven ? "proven" : fit.coverageProven ? "proven, not reachable" : "NOT proven");
  }
}

}  // namespace cairn::tool
