// SPDX-License-Identifier: GPL-3.0-or-later
#include "converge_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>

#include "outputs.h"
#include "scenes/heap/heap_report_json.h"
#include "table.h"

namespace cairn::frame_budget {
namespace {

using scenes::ContactAccuracy;
using scenes::Quantiles;
using scenes::ShapeKind;

std::string errorCell(double mean, const Quantiles& q) {
  return fmt::format("{} / {} / {}", percent(mean), percent(q.p99), percent(q.max));
}

void printAccuracy(const Options& options, const Table& table, const std::vector<ConvergeRun>& runs) {
  const auto row = [&](const char* title, const std::function<std::string(const ContactAccuracy&)>& cell) {
    table.row(title, [&](std::size_t c) { return cell(runs[c].report.accuracy); });
  };
  row(fmt::format("against the exact meshes, every {} frames:", options.truthEvery).c_str(),
      [](const auto&) { return std::string(); });
  row("  pairs that meet / reported",
      [](const auto& a) { return fmt::format("{} / {}", a.truePairs, a.reportedPairs); });
  row("  missed: pairs (deepest, % of size)",
      [](const auto& a) { return a.missed ? fmt::format("{} ({})", a.missed, percent(a.deepestMissed)) : "none"; });
  table.row("  missed deeper than the certified error", [&](std::size_t c) {
    return runs[c].report.cost.tree ? std::to_string(runs[c].report.accuracy.missedBeyondCertificate) : "-";
  });
  row("  false: gap, % of size (pairs)", [](const auto& a) { return spreadCell(a.falseGap); });
  row("  contact error, %: mean / 99 % / max", [](const auto& a) { return errorCell(a.meanError, a.error); });
  row("  nearer mesh, %: mean / 99 % / max", [](const auto& a) { return errorCell(a.meanStray, a.stray); });
}

}  // namespace

nlohmann::ordered_json accuracyToJson(const ContactAccuracy& a) {
  nlohmann::ordered_json json;
  json["frames_checked"] = a.frames;
  json["true_pairs"] = a.truePairs;
  json["reported_pairs"] = a.reportedPairs;
  json["missed_pairs"] = a.missed;
  json["missed_depth_fraction"] = {{"max", a.deepestMissed}};
  json["missed_beyond_certified_error"] = a.missedBeyondCertificate;
  json["false_pairs_gap_fraction"] = scenes::toJson(a.falseGap);
  json["contact_error_fraction"] = {{"mean", a.meanError}, {"p99", a.error.p99}, {"max", a.error.max}};
  json["contact_nearer_mesh_fraction"] = {{"mean", a.meanStray}, {"p99", a.stray.p99}, {"max", a.stray.max}};
  return json;
}

namespace {

/// Keys of simulations are null here, so that every scene's report has the same keys.
nlohmann::ordered_json nothingSimulated() {
  nlohmann::ordered_json json;
  for (const char* key : {"penetration_end_fraction", "gap_end_fraction"})
    json[key] = {{"mean", nullptr}, {"max", nullptr}};
  for (const char* key :
       {"peak_speed_m_per_s", "kinetic_energy_end_j_per_kg", "bodies_lost", "bodies_asleep", "state_hash"})
    json[key] = nullptr;
  return json;
}

const ConvergeRun* findRun(const std::vector<ConvergeRun>& runs, ShapeKind shape) {
  const auto run = std::ranges::find(runs, shape, &ConvergeRun::shape);
  return run == runs.end() ? nullptr : &*run;
}

}  // namespace

std::optional<ExactPeerRatio> ratioToExactPeer(const std::vector<ConvergeRun>& runs) {
  const ConvergeRun* const tree = findRun(runs, ShapeKind::tree);
  const ConvergeRun* fastest = nullptr;
  const auto times = [](const ConvergeRun& run) -> const Quantiles& { return run.report.cost.narrowPhaseCpuUs; };
  for (const ShapeKind shape : {ShapeKind::gimpact, ShapeKind::fcl}) {
    const ConvergeRun* const peer = findRun(runs, shape);
    if (peer && (!fastest || times(*peer).median < times(*fastest).median)) fastest = peer;
  }
  if (!tree || !fastest || times(*fastest).median <= 0) return {};
  return ExactPeerRatio{fastest->shape, times(*tree).median / times(*fastest).median,
                        times(*tree).p99 / times(*fastest).p99};
}

void printConvergeTable(const Options& options, const scenes::SourcedTree& tree, const std::string& posesHash,
                        const std::vector<ConvergeRun>& runs) {
  fmt::print("converge of {} x {} ({} triangles, {} leaf spheres), {} runs of {} frames, seed {}, flying {}\n",
             options.heap.bodies, tree.meshName, tree.tree->triangles().size(), tree.tree->leafCount(),
             options.converge.runs, options.converge.frames, options.converge.seed,
             options.converge.meeting == scenes::Meeting::through ? "through each other" : "and bouncing");
  fmt::print("the same poses for every shape: {}\n\n", posesHash);
  std::vector<std::string> names;
  std::vector<const scenes::RunCost*> costs;
  for (const ConvergeRun& run : runs) {
    names.emplace_back(scenes::shapeName(run.shape));
    costs.push_back(&run.report.cost);
  }
  const Table table(std::move(names));
  printCost(table, costs);
  if (const auto ratio = ratioToExactPeer(runs))
    table.row(fmt::format("tree / {}: median, 99 %", scenes::shapeName(ratio->peer)), [&](std::size_t c) {
      return runs[c].shape == ShapeKind::tree ? fmt::format("1/{:.1f}, 1/{:.1f}", 1 / ratio->median, 1 / ratio->p99)
                                              : std::string();
    });
  printAccuracy(options, table, runs);
}

nlohmann::ordered_json toJson(const Options& options, const scenes::SourcedTree& tree, const std::string& posesHash,
                              const ConvergeRun& run, const std::optional<ExactPeerRatio>& ratio) {
  nlohmann::ordered_json json = describeRun(options, tree, run.shape);
  json["runs"] = options.converge.runs;
  json["meeting"] = scenes::meetingName(options.converge.meeting);
  json["truth_every"] = options.truthEvery;
  json["poses_hash"] = posesHash;
  json.update(scenes::toJson(run.report.cost));
  json.update(accuracyToJson(run.report.accuracy));
  json.update(nothingSimulated());
  if (run.shape == ShapeKind::tree && ratio)
    json["ratio_to_faster_exact_peer"] = {
        {"peer", scenes::shapeName(ratio->peer)}, {"median", ratio->median}, {"p99", ratio->p99}};
  return json;
}

}  // namespace cairn::frame_budget
