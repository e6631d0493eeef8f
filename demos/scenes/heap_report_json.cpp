// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap_report_json.h"

namespace cairn::scenes {
namespace {

using Json = nlohmann::ordered_json;

Json timesToJson(const Quantiles& q) {
  return {{"median", q.median}, {"p99", q.p99}, {"p999", q.p999}, {"max", q.max}};
}
Json countsToJson(const Quantiles& q) {
  return {{"median", q.median}, {"max", q.max}};
}
Json spreadToJson(const Spread& s) {
  return {{"mean", s.mean}, {"max", s.max}, {"pairs", s.pairs}};
}

}  // namespace

Json toJson(const HeapReport& report) {
  const auto& tree = report.tree;
  Json json;
  json["narrow_phase_cpu_us"] = timesToJson(report.narrowPhaseCpuUs);
  json["step_cpu_us"] = timesToJson(report.stepCpuUs);
  json["operations"] = tree ? countsToJson(tree->operations) : Json{{"median", nullptr}, {"max", nullptr}};
  json["contacts"] = countsToJson(report.contacts);
  json["manifolds"] = countsToJson(report.manifolds);
  json["certified_error_fraction"] = tree ? Json{{"mean", tree->meanErrorFraction}, {"max", tree->maxErrorFraction}}
                                          : Json{{"mean", nullptr}, {"max", nullptr}};
  json["unresolved_pairs_fraction"] = tree ? Json(tree->unresolvedPairFraction) : Json(nullptr);
  json["penetration_end_fraction"] = spreadToJson(report.end.depth);
  json["gap_end_fraction"] = spreadToJson(report.end.gap);
  json["pit_penetration_end_fraction"] = spreadToJson(report.end.pitDepth);
  json["pit_gap_end_fraction"] = spreadToJson(report.end.pitGap);
  json["peak_speed_m_per_s"] = report.peakSpeed;
  json["kinetic_energy_end_j_per_kg"] = report.kineticEnergyEnd;
  json["bodies_lost"] = report.lost;
  json["bodies_asleep"] = report.asleep;
  json["state_hash"] = report.stateHash;
  return json;
}

}  // namespace cairn::scenes
