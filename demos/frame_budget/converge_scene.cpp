// SPDX-License-Identifier: GPL-3.0-or-later
#include "converge_scene.h"

#include <utility>

#include "outputs.h"
#include "scenes/command/program.h"

namespace cairn::frame_budget {
namespace {

using Players = std::vector<std::unique_ptr<scenes::Player>>;

Result<Players> makePlayers(std::span<const Entrant> entrants) {
  Players players;
  for (const auto& [options, shape, model] : entrants) {
    scenes::WorldOptions world = options->heap.world;
    world.shape = shape;
    auto player = scenes::makePlayer(*model, options->heap.bodies, world, options->heap.shape);
    if (!player) return player.error();
    players.push_back(std::move(player).value());
  }
  return players;
}

}  // namespace

Result<ConvergeRuns> runConverge(std::span<const Entrant> entrants, const std::string& title) {
  const auto players = makePlayers(entrants);
  if (!players) return players.error();
  const Options& options = *entrants.front().options;
  const scenes::Model& model = *entrants.front().model;
  scenes::ProgressLine progress(title);
  const auto recording = scenes::recordConverge(model, options.converge);
  if (!recording) return recording.error();
  auto reports = scenes::playRecording(recording.value(), model, players.value(), options.truthEvery,
                                       [&](double fraction) { return progress.show("of the turns", fraction); });
  if (!reports) return reports.error();
  ConvergeRuns found{recording.value().hash(), {}};
  for (std::size_t i = 0; i < entrants.size(); ++i)
    found.runs.push_back({entrants[i].shape, std::move(reports.value()[i])});
  return found;
}

Status measureConverge(const Options& options, const scenes::SourcedTree& source, const scenes::Model& model) {
  std::vector<Entrant> entrants;
  for (const scenes::ShapeKind shape : options.shapes) entrants.push_back({&options, shape, &model});
  const auto found = runConverge(entrants, "converge");
  if (!found) return found.error();
  const auto& [hash, runs] = found.value();
  printConvergeTable(options, source, hash, runs);
  std::vector<nlohmann::ordered_json> objects;
  std::vector<LoggedRun> logged;
  for (const ConvergeRun& run : runs) {
    objects.push_back(toJson(options, source, hash, run, ratioToExactPeer(runs)));
    logged.push_back({run.shape, run.report.records});
  }
  return writeOutputs(options, objects, logged);
}

}  // namespace cairn::frame_budget
