// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/contest.h"

#include <memory>
#include <utility>

namespace cairn::accuracy_cost {
namespace {

using scenes::ShapeKind;

/// The shapes that a build may lack.
bool isOptional(ShapeKind shape) {
  return shape == ShapeKind::compound || shape == ShapeKind::fcl;
}

/// The players, and the contender of each.
struct Players {
  std::vector<std::unique_ptr<scenes::Player>> players;
  std::vector<std::size_t> numbers;
};

Result<Players> makePlayers(const std::vector<Contender>& contenders, std::uint32_t bodies) {
  Players made;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const Contender& contender = contenders[i];
    scenes::WorldOptions world;
    world.shape = contender.shape;
    world.budget.operations = contender.operations;
    const scenes::ShapeOptions shape{.marginFraction = contender.margin, .sphereLevel = contender.depth};
    auto player = scenes::makePlayer(*contender.model, bodies, world, shape);
    if (!player && isOptional(contender.shape)) continue;
    if (!player) return player.error();
    made.players.push_back(std::move(player).value());
    made.numbers.push_back(i);
  }
  return made;
}

double meanTime(const std::vector<scenes::StepRecord>& records) {
  double sum = 0;
  for (const scenes::StepRecord& record : records) sum += record.narrowPhaseCpuUs;
  return sum / static_cast<double>(records.size());
}

}  // namespace

Result<std::vector<std::optional<Outcome>>> holdContest(const scenes::Recording& recording,
                                                        const std::vector<Contender>& contenders,
                                                        std::uint32_t truthEvery, std::uint32_t repetitions,
                                                        const std::function<bool(double)>& progress) {
  const auto made = makePlayers(contenders, recording.bodies);
  if (!made) return made.error();
  const auto& [players, numbers] = made.value();
  std::vector<std::optional<Outcome>> outcomes(contenders.size());
  std::vector<std::vector<double>> times(players.size()), ratios(players.size());
  for (std::uint32_t repetition = 0; repetition < repetitions; ++repetition) {
    // Times come from all repetitions, errors from the first: they have the same bits in each.
    const std::uint32_t every = repetition == 0 ? truthEvery : recording.framesPerRun;
    const auto reports = scenes::playRecording(recording, *contenders.front().model, players, every, [&](double done) {
      return !progress || progress((repetition + done) / repetitions);
    });
    if (!reports) return reports.error();
    const double reference = meanTime(reports.value().front().records);
    for (std::size_t i = 0; i < players.size(); ++i) {
      const scenes::ConvergeReport& report = reports.value()[i];
      times[i].push_back(meanTime(report.records));
      ratios[i].push_back(times[i].back() / reference);
      if (repetition > 0) continue;
      const auto& tree = report.cost.tree;
      outcomes[numbers[i]] =
          Outcome{report.accuracy, tree ? tree->meanErrorFraction : 0, tree ? tree->operations.median : 0, {}, {}};
    }
  }
  for (std::size_t i = 0; i < players.size(); ++i) {
    outcomes[numbers[i]]->timeUs = medianOf(std::move(times[i]));
    outcomes[numbers[i]]->timeOverReference = medianOf(std::move(ratios[i]));
  }
  return outcomes;
}

}  // namespace cairn::accuracy_cost
