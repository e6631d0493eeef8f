// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/heap_report_json.h"

namespace cairn::scenes {
namespace {

using Json = nlohmann::ordered_json;

Json timesToJson(const Quantiles& q) {
  return {{"median", q.median}, {"p99", q.p99}, {"p999", q.p999}, {"max", q.max}};
}
Json toJson(const DeadlineKept& kept) {
  Json elapsed = timesToJson(kept.elapsedUs);
  elapsed["p9999"] = kept.elapsedUs.p9999;
  return {{"elapsed_us", elapsed},
          {"late_steps", kept.lateSteps},
          {"worst_miss_us", kept.worstMissUs},
          {"worst_miss_off_cpu_us", kept.worstMissOffCpuUs}};
}
Json countsToJson(const Quantiles& q) {
  return {{"median", q.median}, {"max", q.max}};
}

}  // namespace

Json toJson(const Spread& s) {
  return {{"mean", s.mean}, {"max", s.max}, {"pairs", s.pairs}};
}

Json toJson(const RunCost& cost) {
  const auto& tree = cost.tree;
  Json json;
  json["narrow_phase_cpu_us"] = timesToJson(cost.narrowPhaseCpuUs);
  json["step_cpu_us"] = timesToJson(cost.stepCpuUs);
  json["deadline"] = cost.deadline ? toJson(*cost.deadline) : Json(nullptr);
  json["operations"] = tree ? countsToJson(tree->operations) : Json{{"median", nullptr}, {"max", nullptr}};
  json["contacts"] = countsToJson(cost.contacts);
  json["manifolds"] = countsToJson(cost.manifolds);
  json["certified_error_fraction"] = tree ? Json{{"mean", tree->meanErrorFraction}, {"max", tree->maxErrorFraction}}
                                          : Json{{"mean", nullptr}, {"max", nullptr}};
  json["unresolved_pairs_fraction"] = tree ? Json(tree->unresolvedPairFraction) : Json(nullptr);
  json["exact_contacts_fraction"] = tree ? Json(tree->exactContactFraction) : Json(nullptr);
  return json;
}

Json toJson(const HeapReport& report) {
  Json json = toJson(report.cost);
  if (report.cut)
    for (const auto& [name, part] :
         {std::pair("before_budget", report.cut->before), {"with_budget", report.cut->after}})
      json[name] = {{"operations", {{"median", part.operations}}},
                    {"certified_error_fraction", {{"max", part.worstErrorFraction}}}};
  json["penetration_end_fraction"] = toJson(report.end.depth);
  json["gap_end_fraction"] = toJson(report.end.gap);
  json["pit_penetration_end_fraction"] = toJson(report.end.pitDepth);
  json["pit_gap_end_fraction"] = toJson(report.end.pitGap);
  json["peak_speed_m_per_s"] = report.peakSpeed;
  json["kinetic_energy_end_j_per_kg"] = report.kineticEnergyEnd;
  json["bodies_lost"] = report.lost;
  json["bodies_asleep"] = report.asleep;
  json["state_hash"] = report.stateHash;
  return json;
}

}  // namespace cairn::scenes
