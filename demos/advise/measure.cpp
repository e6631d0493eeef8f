// SPDX-License-Identifier: GPL-3.0-or-later
#include "advise/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "advise/sieve.h"
#include "advise/take.h"
#include "scenes/converge/converge.h"

namespace cairn::advise {
namespace {

/// Metres: a size that suits Bullet.
constexpr double kBodySize = 1;
/// Budgets, in operations per body and step.
constexpr std::array<std::uint64_t, 9> kBudgets{25, 50, 100, 200, 400, 800, 1600, 3200, 6400};
/// Budgets that may cut nothing, each a quarter above the last.
constexpr int kUncutTrials = 10;
/// Finished shares of the work after the trees are built, and after the poses are recorded.
constexpr double kBuilt = 0.5, kRecorded = 0.55;
/// Finished share of the plays when every tree was played once and a sieve follows.
constexpr double kSieved = 0.6;

Error cancelled() {
  return Error{std::string(builder::kCancelled)};
}

/// A tree in a body, with every budget.
struct Contender {
  Candidate candidate;
  scenes::Model model;
  std::vector<Take> takes;
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
        {candidate, scenes::makeModel(std::make_shared<const SphereTree>(std::move(tree).value()), kBodySize), {}});
    // Poses refer to the body frame, so all trees must have the same one.
    if (contenders.back().model.vertices != contenders.front().model.vertices)
      return Error{nameOf(candidate) + ": the tree's body frame is not that of the others"};
  }
  return contenders;
}

/// All trees on one recording, with the number of plays of each.
class Race {
 public:
  Race(const scenes::Recording& recording, std::vector<Contender>& contenders, const Trial& trial,
       const builder::ProgressCallback& progress)
      : recording_(recording), contenders_(contenders), trial_(trial), progress_(progress) {}

  /// Plays every tree with every budget that cuts, one that does not, and none: once, or the full number of times
  /// without a sieve.
  Status playAll() {
    for (Contender& contender : contenders_)
      if (Status played = playFirst(contender); !played) return played;
    for (Contender& contender : contenders_) settle(contender);
    return trial_.sieveUs || frames_.empty() ? Status() : playUpTo(all(), full());
  }

  /// Doubles the plays of the better half, then of the better half of these, until few are left. These trees, and every
  /// tree that would then be chosen, get the full number of plays. Precondition: there are busy frames.
  Status sieve() {
    std::vector<std::size_t> running = all();
    for (std::uint32_t playings = 2; running.size() > kFinalists; playings *= 2) {
      running = betterHalf(candidates(), running, *trial_.sieveUs);
      if (Status played = playUpTo(running, std::min(playings, full())); !played) return played;
    }
    if (Status played = playUpTo(running, full()); !played) return played;
    for (std::size_t chosen = choice(); contenders_[chosen].candidate.playings < full(); chosen = choice())
      if (Status played = playUpTo({chosen}, full()); !played) return played;
    return {};
  }

  const std::vector<std::uint32_t>& busyFrames() const { return frames_; }
  std::vector<Candidate> candidates() const {
    std::vector<Candidate> list;
    for (const Contender& contender : contenders_) list.push_back(contender.candidate);
    return list;
  }

 private:
  std::uint32_t full() const { return 1 + trial_.repeats; }

  std::vector<std::size_t> all() const {
    std::vector<std::size_t> places(contenders_.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    return places;
  }

  std::size_t choice() const {
    const std::vector<Candidate> list = candidates();
    return bestChoice(list, *trial_.sieveUs).value_or(cheapestChoice(list)).candidate;
  }

  Status playFirst(Contender& contender) {
    Take whole(std::nullopt);
    if (Status played = play(whole, contender); !played) return played;
    addFrames(whole.busyFrames());
    for (const std::uint64_t each : kBudgets)
      if (each * trial_.bodies < whole.mostOperations()) contender.takes.emplace_back(each * trial_.bodies);
    for (Take& take : contender.takes)
      if (Status played = play(take, contender); !played) return played;
    if (Status played = playUncut(contender, std::move(whole)); !played) return played;
    ++begun_;
    return {};
  }

  /// Each tree has contacts in its own frames. Their union does not depend on the order of the trees.
  void addFrames(const std::vector<std::uint32_t>& busy) {
    std::vector<std::uint32_t> together;
    std::ranges::set_union(frames_, busy, std::back_inserter(together));
    frames_ = std::move(together);
  }

  /// Adds the least budget found without unresolved pairs, if any. It exceeds the operations without a budget, because
  /// a budget changes the order of pairs. Then adds `whole`, without a budget: a budget costs time even if it cuts
  /// nothing.
  Status playUncut(Contender& contender, Take whole) {
    std::uint64_t budget = std::max<std::uint64_t>(whole.mostOperations(), 1);
    for (int i = 0; i < kUncutTrials; ++i, budget += (budget + 3) / 4) {
      Take take(budget);
      if (Status played = play(take, contender); !played) return played;
      if (take.cuts()) continue;
      contender.takes.push_back(std::move(take));
      break;
    }
    contender.takes.push_back(std::move(whole));
    return {};
  }

  /// Plays the trees with fewer plays, in turns.
  Status playUpTo(const std::vector<std::size_t>& places, std::uint32_t playings) {
    for (std::uint32_t done = 1; done < playings; ++done)
      for (const std::size_t place : places) {
        Contender& contender = contenders_[place];
        if (contender.candidate.playings > done) continue;
        for (Take& take : contender.takes)
          if (Status played = play(take, contender); !played) return played;
        settle(contender);
      }
    return {};
  }

  Status play(Take& take, const Contender& contender) {
    const double share = static_cast<double>(begun_) / static_cast<double>(contenders_.size());
    const double done = kRecorded + share * (1 - kRecorded) * (trial_.sieveUs ? kSieved : 1.0 / full());
    if (progress_ && !progress_(nameOf(contender.candidate), done)) return cancelled();
    return take.play(recording_, contender.model);
  }

  void settle(Contender& contender) const {
    contender.candidate.playings = contender.takes.front().playings();
    contender.candidate.rungs.clear();
    if (frames_.empty()) return;
    for (const Take& take : contender.takes) contender.candidate.rungs.push_back(take.rung(frames_));
  }

  const scenes::Recording& recording_;
  std::vector<Contender>& contenders_;
  const Trial& trial_;
  const builder::ProgressCallback& progress_;
  std::vector<std::uint32_t> frames_;  ///< frames in which any tree has contacts without cuts
  std::size_t begun_ = 0;              ///< number of trees with at least one play
};

}  // namespace

Result<Measured> measure(const builder::TriangleMesh& mesh, const Trial& trial,
                         const builder::ProgressCallback& progress) {
  auto contenders = buildTrees(mesh, trial, progress);
  if (!contenders) return contenders.error();
  if (progress && !progress("recording poses", kBuilt)) return cancelled();
  const auto recording = scenes::recordConverge(
      contenders.value().front().model,
      {.bodies = trial.bodies, .runs = trial.starts, .frames = trial.frames, .seed = trial.seed});
  if (!recording) return recording.error();
  Race race(recording.value(), contenders.value(), trial, progress);
  if (Status played = race.playAll(); !played) return played.error();
  if (race.busyFrames().empty()) return Error{"no bodies touch: give more of them with --bodies, or more --frames"};
  if (trial.sieveUs)
    if (Status played = race.sieve(); !played) return played.error();
  return Measured{race.candidates(), static_cast<std::uint32_t>(race.busyFrames().size()), recording.value().hash()};
}

}  // namespace cairn::advise
