// SPDX-License-Identifier: GPL-3.0-or-later
#include "converge_scene.h"

#include <string>
#include <utility>

#include "converge_report.h"
#include "outputs.h"
#include "scenes/command/program.h"

namespace cairn::frame_budget {
namespace {

using Players = std::vector<std::unique_ptr<scenes::Player>>;

Result<Players> makePlayers(const Options& options, const scenes::Model& model) {
  Players players;
  for (const scenes::ShapeKind shape : options.shapes) {
    scenes::WorldOptions world = options.heap.world;
    world.shape = shape;
    auto player = scenes::makePlayer(model, options.heap.bodies, world, options.heap.shape);
    if (!player) return player.error();
    players.push_back(std::move(player).value());
  }
  return players;
}

}  // namespace

Status measureConverge(const Options& options, const scenes::SourcedTree& source, const scenes::Model& model) {
  const auto players = makePlayers(options, model);
  if (!players) return players.error();
  scenes::ProgressLine progress("converge");
  const auto recording = scenes::recordConverge(model, options.converge);
  if (!recording) return recording.error();
  auto reports = scenes::playRecording(recording.value(), model, players.value(), options.truthEvery,
                                       [&](double fraction) { return progress.show("of the turns", fraction); });
  if (!reports) return reports.error();

  std::vector<ConvergeRun> runs;
  for (std::size_t i = 0; i < options.shapes.size(); ++i)
    runs.push_back({options.shapes[i], std::move(reports.value()[i])});
  const std::string hash = recording.value().hash();
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
