// SPDX-License-Identifier: GPL-3.0-or-later
#include "advise/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "scenes/converge/converge.h"
#include "scenes/converge/player.h"
#include "scenes/figures/quantiles.h"

namespace cairn::advise {
namespace {

/// Metres: what Bullet is at ease with.
constexpr double kBodySize = 1;
/// Budgets, operations a body and step.
constexpr std::array<std::uint64_t, 9> kBudgets{25, 50, 100, 200, 400, 800, 1600, 3200, 6400};
/// Shares of the work that are done when the trees are built, and when the poses are recorded too.
constexpr double kBuilt = 0.5, kRecorded = 0.55;

Error cancelled() {
  return Error{std::string(builder::kCancelled)};
}

/// A tree in a body.
struct Contender {
  Candidate candidate;
  scenes::Model model;
};

std::vector<Candidate> candidatesOf(const Trial& trial) {
  std::vector<Candidate> candidates;
  for (const builder::Method method : trial.methods)
    for (const std::uint32_t branching : trial.branchings) {
      if (builder::dividesByEight(method) && branching != 8) continue;
      for (const std::uint32_t depth : trial.depths)
        candidates.push_back({.method = method, .branching = branching, .depth = depth, .rungs = {}});
    }
  return candidates;
}

std::string nameOf(const Candidate& candidate) {
  return fmt::format("{}, {} children, {} levels", builder::methodName(candidate.method), candidate.branching,
                     candidate.depth);
}

Result<std::vector<Contender>> buildTrees(const builder::TriangleMesh& mesh, const Trial& trial,
                                          const builder::ProgressCallback& progress) {
  std::vector<Contender> contenders;
  const std::vector<Candidate> candidates = candidatesOf(trial);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Candidate candidate = candidates[i];
    const auto inside = [&](std::string_view, double fraction) {
      return !progress || progress(nameOf(candidate), kBuilt * (static_cast<double>(i) + fraction) /
                                                          static_cast<double>(candidates.size()));
    };
    const auto start = std::chrono::steady_clock::now();
    auto tree = builder::buildTree(mesh,
                                   {.method = candidate.method,
                                    .branching = candidate.branching,
                                    .depth = candidate.depth,
                                    .seed = trial.seed,
                                    .optimiser = {},
                                    .balance = {}},
                                   inside);
    if (!tree) return tree.error();
    candidate.buildSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    candidate.spheres = tree.value().nodeCount();
    contenders.push_back(
        {candidate, scenes::makeModel(std::make_shared<const SphereTree>(std::move(tree).value()), kBodySize)});
    // Poses are of the body frame: all trees have to mean the same by it.
    if (contenders.back().model.vertices != contenders.front().model.vertices)
      return Error{nameOf(candidate) + ": the tree's body frame is not that of the others"};
  }
  return contenders;
}

/// What a tree did on one budget, frame by frame; times are the least of all repeats.
class Take {
 public:
  explicit Take(std::optional<std::uint64_t> budget) : budget_(budget) {}

  Status play(const scenes::Recording& recording, const scenes::Model& model) {
    scenes::WorldOptions world;
    if (budget_) world.budget.operations = static_cast<std::int64_t>(*budget_);
    const auto player = scenes::makePlayer(model, recording.bodies, world, {});
    if (!player) return player.error();
    const bool isFirst = records_.empty();
    for (std::uint32_t frame = 0; frame < recording.framesPerRun; ++frame) {
      const scenes::StepRecord record = player.value()->show(recording.frame(0, frame));
      if (isFirst) {
        records_.push_back(record);
      } else {
        double& us = records_[frame].narrowPhaseCpuUs;
        us = std::min(us, record.narrowPhaseCpuUs);
      }
    }
    return {};
  }

  const std::vector<scenes::StepRecord>& records() const { return records_; }

  Rung rung(const std::vector<std::uint32_t>& frames) const {
    Rung rung;
    std::vector<double> times;
    std::uint64_t most = 0;
    double operations = 0, errors = 0, pairs = 0, unresolved = 0;
    for (const std::uint32_t frame : frames) {
      const bullet::StepStatistics& tree = *records_[frame].tree;
      times.push_back(records_[frame].narrowPhaseCpuUs);
      most = std::max(most, tree.operations);
      operations += static_cast<double>(tree.operations);
      errors += tree.meanErrorFraction;
      rung.worstError = std::max(rung.worstError, tree.worstErrorFraction);
      pairs += tree.pairs;
      unresolved += tree.unresolvedPairs;
    }
    const auto count = static_cast<double>(frames.size());
    const scenes::Quantiles quantiles = scenes::quantilesOf(std::move(times));
    rung.budget = budget_.value_or(most);
    rung.cuts = unresolved > 0;
    rung.meanOperations = operations / count;
    rung.medianUs = quantiles.median;
    rung.p99Us = quantiles.p99;
    rung.meanError = errors / count;
    rung.unresolvedPairs = pairs > 0 ? unresolved / pairs : 0;
    return rung;
  }

 private:
  std::optional<std::uint64_t> budget_;
  std::vector<scenes::StepRecord> records_;
};

std::uint64_t mostOperations(const Take& take) {
  std::uint64_t most = 0;
  for (const scenes::StepRecord& record : take.records()) most = std::max(most, record.tree->operations);
  return most;
}

/// Every budget of a tree that cuts something, then none, in turns; what none takes is played once more, to know which
/// cut.
Result<std::vector<Take>> playTree(const scenes::Recording& recording, const scenes::Model& model, const Trial& trial,
                                   const std::function<bool()>& keepGoing) {
  std::vector<Take> takes;
  Take whole(std::nullopt);
  if (Status played = whole.play(recording, model); !played) return played.error();
  for (const std::uint64_t each : kBudgets)
    if (each * trial.bodies < mostOperations(whole)) takes.emplace_back(each * trial.bodies);
  takes.push_back(std::move(whole));
  for (std::uint32_t repeat = 0; repeat < trial.repeats; ++repeat)
    for (Take& take : takes) {
      if (!keepGoing()) return cancelled();
      if (Status played = take.play(recording, model); !played) return played.error();
    }
  return takes;
}

/// The frames in which the bodies touch, as the first tree sees it when nothing is cut.
std::vector<std::uint32_t> busyFrames(const Take& whole) {
  std::vector<std::uint32_t> frames;
  for (std::uint32_t frame = 0; frame < whole.records().size(); ++frame)
    if (whole.records()[frame].contacts > 0) frames.push_back(frame);
  return frames;
}

}  // namespace

Result<Measured> measure(const builder::TriangleMesh& mesh, const Trial& trial,
                         const builder::ProgressCallback& progress) {
  const auto tell = [&](const std::string& what, double fraction) { return !progress || progress(what, fraction); };
  auto contenders = buildTrees(mesh, trial, progress);
  if (!contenders) return contenders.error();
  if (!tell("recording poses", kBuilt)) return cancelled();
  const auto recording =
      scenes::recordConverge(contenders.value().front().model,
                             {.bodies = trial.bodies, .runs = 1, .frames = trial.frames, .seed = trial.seed});
  if (!recording) return recording.error();
  Measured measured;
  measured.recording = recording.value().hash();
  std::vector<std::uint32_t> frames;
  for (std::size_t i = 0; i < contenders.value().size(); ++i) {
    Contender& contender = contenders.value()[i];
    const double done = static_cast<double>(i) / static_cast<double>(contenders.value().size());
    const auto keepGoing = [&] { return tell(nameOf(contender.candidate), kRecorded + (1 - kRecorded) * done); };
    const auto takes = playTree(recording.value(), contender.model, trial, keepGoing);
    if (!takes) return takes.error();
    if (i == 0) frames = busyFrames(takes.value().back());
    if (frames.empty()) return Error{"no bodies touch: give more of them with --bodies, or more --frames"};
    for (const Take& take : takes.value()) contender.candidate.rungs.push_back(take.rung(frames));
    measured.candidates.push_back(std::move(contender.candidate));
  }
  measured.busyFrames = static_cast<std::uint32_t>(frames.size());
  return measured;
}

}  // namespace cairn::advise
