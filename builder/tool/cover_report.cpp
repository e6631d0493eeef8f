// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/cover_report.h"

#include <fmt/format.h>

#include "cairn/builder/grain.h"
#include "tool/grain_report.h"

namespace cairn::tool {
namespace {

Json enclosed(const builder::EnclosedDistance& distance, double diagonal) {
  return {{"at_most", distance.upper},
          {"at_least", distance.lower},
          {"at_most_fraction", distance.upper / diagonal},
          {"at_least_fraction", distance.lower / diagonal}};
}

Json sampledJson(const builder::LevelFit& fit) {
  return {{"sticks_out_fraction", fit.sampledMaxFraction},
          {"sticks_out_rms_fraction", fit.sampledRmsFraction},
          {"uncovered_area_fraction", fit.uncoveredAreaFraction},
          {"uncovered_volume_fraction", fit.uncoveredVolumeFraction},
          {"uncovered_depth_max_fraction", fit.uncoveredDepthMaxFraction},
          {"excess_volume_fraction", fit.wastedVolumeFraction},
          {"excess_volume_standard_error_fraction", fit.wastedVolumeStandardErrorFraction}};
}

}  // namespace

Json certifiedJson(const builder::BallsCertificate& certificate, double diagonal) {
  return {{"sticks_out", enclosed(certificate.sticksOut, diagonal)},
          {"leaves_out_surface", enclosed(certificate.leavesSurface, diagonal)},
          {"leaves_out_solid", enclosed(certificate.leavesSolid, diagonal)},
          {"surface_covered", certificate.leavesSurface.upper == 0}};
}

void printCertified(const builder::BallsCertificate& certificate, double diagonal) {
  const auto line = [&](const char* what, const builder::EnclosedDistance& d) {
    fmt::print("  {:<32} {:9.4f} %  (at least {:.4f} %)\n", what, 100 * d.upper / diagonal, 100 * d.lower / diagonal);
  };
  fmt::print("Proved, of the diagonal ({:.6g} mesh units), at most:\n", diagonal);
  line("spheres stick out", certificate.sticksOut);
  line("surface is left out", certificate.leavesSurface);
  line("solid is left out", certificate.leavesSolid);
}

Json coverJson(const CoverReport& report) {
  const builder::Cover& cover = report.cover;
  const double diagonal = builder::boundsOf(report.mesh).diagonal();
  Json json = {{"mesh", report.mesh.name},
               {"mesh_sha256", report.mesh.sha256},
               {"objective", builder::objectiveName(report.options.objective)},
               {"seed", report.options.seed},
               {"spheres", cover.balls.size()},
               {"diagonal", diagonal},
               {"certified_error", cover.error(report.options.objective)},
               {"certified_error_fraction", cover.error(report.options.objective) / diagonal}};
  if (report.options.maxError) json["max_error"] = *report.options.maxError;
  json["certified"] = certifiedJson(cover.certificate, diagonal);
  if (report.sampled) json["sampled"] = sampledJson(*report.sampled);
  const MassProperties mesh = builder::massOf(report.mesh), spheres = builder::massOf(cover.balls);
  json["volume_ratio"] = spheres.volume / mesh.volume;
  json["mass"] = {{"mesh", massJson(mesh, 1)}, {"spheres", massJson(spheres, 1)}};
  if (cover.mirror)
    json["mirror"] = {{"normal", {cover.mirror->normal.x, cover.mirror->normal.y, cover.mirror->normal.z}},
                      {"offset", cover.mirror->offset},
                      {"deviation_fraction", cover.mirror->deviation / diagonal}};
  return json;
}

void printCover(const CoverReport& report) {
  const double diagonal = builder::boundsOf(report.mesh).diagonal();
  printCertified(report.cover.certificate, diagonal);
  if (report.sampled)
    fmt::print("Sampled: sticks out {:.4f} %, uncovered area {:.4f} %, volume outside {:.3f} % of the solid's\n",
               100 * report.sampled->sampledMaxFraction, 100 * report.sampled->uncoveredAreaFraction,
               100 * report.sampled->wastedVolumeFraction);
  if (report.cover.mirror)
    fmt::print("Mirrored at normal ({:.6f}, {:.6f}, {:.6f}), offset {:.6g}; the mesh deviates by at most {:.5f} %\n",
               report.cover.mirror->normal.x, report.cover.mirror->normal.y, report.cover.mirror->normal.z,
               report.cover.mirror->offset, 100 * report.cover.mirror->deviation / diagonal);
}

}  // namespace cairn::tool
