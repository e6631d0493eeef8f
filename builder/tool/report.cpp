// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/report.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "cairn/builder/sha256.h"
#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "tool/interrupt.h"

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
      level["sampled_variance_fraction_squared"] = fit.sampledVarianceFractionSquared;
      level["uncovered_area_fraction"] = fit.uncoveredAreaFraction;
      level["uncovered_volume_fraction"] = fit.uncoveredVolumeFraction;
      level["uncovered_volume_standard_error_fraction"] = fit.uncoveredVolumeStandardErrorFraction;
      level["uncovered_depth_max_fraction"] = fit.uncoveredDepthMaxFraction;
      level["uncovered_depth_rms_fraction"] = fit.uncoveredDepthRmsFraction;
      level["wasted_volume_fraction"] = fit.wastedVolumeFraction;
      level["wasted_volume_standard_error_fraction"] = fit.wastedVolumeStandardErrorFraction;
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
  if (Status s = beginWriting(); !s) return s;
  // A file name may hold bytes that are not UTF-8; they are replaced, not fatal.
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (path != "-") return writeFileAtomically(path, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    return Error{"standard output cannot be written; check where it leads"};
  return {};
}

namespace {

void printProtrusions(const std::vector<builder::LevelFit>& fits, bool full) {
  fmt::print("level  spheres  protrusion, certified  ");
  if (full) fmt::print("sampled                   ");
  fmt::print("cover\n                max %    rms %        ");
  if (full) fmt::print("  max %    rms %    std %   ");
  fmt::print("\n");
  for (const builder::LevelFit& fit : fits) {
    fmt::print("{:5}  {:7} {:8.4f} {:8.4f}        ", fit.level, fit.spheres, 100 * fit.certifiedMaxFraction,
               100 * fit.certifiedRmsFraction);
    if (full)
      fmt::print("{:7.4f}  {:7.4f}  {:7.4f}   ", 100 * fit.sampledMaxFraction, 100 * fit.sampledRmsFraction,
                 100 * std::sqrt(fit.sampledVarianceFractionSquared));
    fmt::print("{}\n", fit.reachableProven ? "proven" : fit.coverageProven ? "proven, not reachable" : "NOT proven");
  }
}

void printVolumes(const std::vector<builder::LevelFit>& fits) {
  fmt::print(
      "level  uncovered                                        wasted\n"
      "        area %  volume % +- error  depth max %  rms %   volume % +- error\n");
  for (const builder::LevelFit& fit : fits)
    fmt::print("{:5} {:8.4f} {:9.3f}   {:6.3f}   {:9.4f} {:8.4f}  {:8.2f}   {:6.2f}\n", fit.level,
               100 * fit.uncoveredAreaFraction, 100 * fit.uncoveredVolumeFraction,
               100 * fit.uncoveredVolumeStandardErrorFraction, 100 * fit.uncoveredDepthMaxFraction,
               100 * fit.uncoveredDepthRmsFraction, 100 * fit.wastedVolumeFraction,
               100 * fit.wastedVolumeStandardErrorFraction);
}

}  // namespace

void printLevels(const std::vector<builder::LevelFit>& fits, builder::Sampling sampling) {
  const bool full = sampling == builder::Sampling::full;
  printProtrusions(fits, full);
  if (full) printVolumes(fits);
}

}  // namespace cairn::tool
