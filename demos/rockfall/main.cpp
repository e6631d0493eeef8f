// SPDX-License-Identifier: GPL-3.0-or-later
// rockfall: concave rocks down a stepped slope, headless, within a narrow-phase budget.
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "cairn/core/atomic_file.h"
#include "options.h"
#include "scenes/command/program.h"
#include "scenes/command/tree_source.h"
#include "scenes/figures/quantiles.h"
#include "scenes/rockfall/rockfall.h"
#include "second_table.h"
#include "trajectory_log.h"

namespace cairn::rockfall {
namespace {

constexpr std::uint32_t kSamplesPerSecond = 10;
constexpr std::uint32_t kStepsPerSample = scenes::Rockfall::kStepsPerSecond / kSamplesPerSecond;

using Trees = std::vector<std::shared_ptr<const SphereTree>>;

Result<Trees> buildRocks(const Options& options) {
  Trees trees;
  for (std::uint32_t i = 0; i < options.distinctRocks; ++i) {
    scenes::TreeSource source;
    source.rock.seed = options.scene.seed + i;
    scenes::ProgressLine progress(fmt::format("building rock {} of {}", i + 1, options.distinctRocks));
    auto tree = scenes::obtainTree(source, progress.callback());
    if (!tree) return tree.error();
    trees.push_back(tree.value().tree);
  }
  return trees;
}

struct Run {
  TrajectoryLog log;
  std::vector<double> narrowPhaseUs, operations;
  double peakSpeed = 0;
  std::uint32_t lost = 0, asleep = 0;
  std::string stateHash;
};

Result<Run> simulate(scenes::Rockfall& scene, const Options& options) {
  Run run;
  SecondTable table(options.scene.budget);
  StateHash hash;
  run.log.sample(0, scene.world());
  for (std::uint32_t step = 1; step <= options.seconds * scenes::Rockfall::kStepsPerSecond; ++step) {
    const scenes::StepRecord record = scene.step();
    table.add(record);
    run.narrowPhaseUs.push_back(record.narrowPhaseCpuUs);
    run.operations.push_back(static_cast<double>(record.tree->operations));
    run.peakSpeed = std::max(run.peakSpeed, scenes::fastestSpeed(scene.world().bodies()));
    if (step % kStepsPerSample == 0)
      run.log.sample(static_cast<double>(step) / scenes::Rockfall::kStepsPerSecond, scene.world());
    if (step % scenes::Rockfall::kStepsPerSecond == 0) {
      table.endSecond(step / scenes::Rockfall::kStepsPerSecond, scene.world(), scene.countLost());
      scene.world().addState(hash);
    }
    if (scenes::interrupted()) return Error{std::string(builder::kCancelled)};
  }
  run.lost = scene.countLost();
  run.asleep = scenes::countAsleep(scene.world().bodies());
  run.stateHash = hash.hex();
  return run;
}

std::string summaryText(const Run& run, const Options& options) {
  const scenes::Quantiles time = scenes::quantilesOf(run.narrowPhaseUs), work = scenes::quantilesOf(run.operations);
  nlohmann::ordered_json json{{"scene", "rockfall"},
                              {"rocks", options.scene.rocks},
                              {"seconds", options.seconds},
                              {"seed", options.scene.seed}};
  const auto& budget = options.scene.budget;
  json["budget_ops"] = budget.operations ? nlohmann::ordered_json(*budget.operations) : nullptr;
  json["budget_us"] = budget.microseconds ? nlohmann::ordered_json(*budget.microseconds) : nullptr;
  json["narrow_phase_cpu_us"] = {{"median", time.median}, {"p99", time.p99}, {"p999", time.p999}, {"max", time.max}};
  json["operations"] = {{"median", work.median}, {"max", work.max}};
  json["peak_speed_m_per_s"] = run.peakSpeed;
  json["bodies_lost"] = run.lost;
  json["bodies_asleep"] = run.asleep;
  json["state_hash"] = run.stateHash;
  return json.dump(2) + "\n";
}

// Before the work, so that nobody waits for what cannot be kept.
Status prepareOutputs(const Options& options) {
  if (options.json)
    if (Status writable = checkWritable(*options.json); !writable) return writable;
  std::error_code failure;
  std::filesystem::create_directories(options.folder, failure);
  if (failure) return Error{fmt::format("cannot make the folder {}: {}", options.folder.string(), failure.message())};
  return checkWritable(options.folder / "trajectories.csv");
}

Status writeResults(const Run& run, const Options& options) {
  if (const Status status = run.log.write(options.folder / "trajectories.csv"); !status) return status;
  return options.json ? writeFileAtomically(*options.json, summaryText(run, options)) : Status();
}

Status runRockfall(const Options& options) {
  if (Status prepared = prepareOutputs(options); !prepared) return prepared;
  const auto trees = buildRocks(options);
  if (!trees) return trees.error();
  auto scene = scenes::Rockfall::create(trees.value(), options.scene);
  if (!scene) return scene.error();
  const auto run = simulate(*scene.value(), options);
  if (!run) return run.error();
  if (options.scene.budget.operations)
    fmt::print(
        "\nAbove 100 % of the budget: contacts known from the step before are re-tested whatever is left of it.\n");
  fmt::print("\nstate hash {}; {} of {} rocks at rest\n", run.value().stateHash, run.value().asleep,
             options.scene.rocks);
  if (const Status status = writeResults(run.value(), options); !status) return status;
  fmt::print("wrote {}\n", (options.folder / "trajectories.csv").string());
  if (run.value().lost > 0) return Error{fmt::format("{} rocks fell through the slope or left it", run.value().lost)};
  return {};
}

}  // namespace
}  // namespace cairn::rockfall

int main(int argc, char** argv) {
  using namespace cairn;
  const auto parsed = rockfall::parseOptions(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  scenes::watchForInterrupt();
  const Status status = rockfall::runRockfall(std::get<rockfall::Options>(parsed));
  return status ? scenes::kExitDone : scenes::refuse("rockfall", status.error());
}
