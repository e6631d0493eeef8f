// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/convergence/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rockfall/convergence/paired_runs.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall {
namespace {

constexpr double kShortestStepS = 1e-5;  // what a case may have, see readCase

double stepAt(double coarsest, std::size_t halvings) {
  return coarsest / std::exp2(static_cast<double>(halvings));
}

struct RockValues {
  ConvergedValues of{};
  bool isCutOff = false;
};

/// What each rock of each run had at one step: run by run.
class StepRuns {
 public:
  StepRuns(Scene& scene, const ConvergenceOptions& options) : scene_(scene), options_(options) {
    for (const RockGroup& group : scene.description.rocks) rocks_ += group.count;
  }

  std::size_t rocks() const { return rocks_; }
  std::size_t runs() const { return static_cast<std::size_t>(options_.runs.last - options_.runs.first); }

  Result<std::vector<RockValues>> at(double stepS, const ShareDone& progress) {
    scene_.description.stepS = stepS;
    const auto compute = [&](std::size_t item, std::span<RockValues> values,
                             const std::function<bool()>& keepGoing) -> Status {
      const auto finished = simulate(scene_, options_.runs.first + item, keepGoing);
      if (!finished) return finished.error();
      for (std::size_t i = 0; i < values.size(); ++i) {
        const RockRecord& rock = finished.value().result.rocks[i];  // pieces come after those that were released
        values[i] = {{rock.runoutM(), rock.maxSpeed, rock.maxEnergyJ}, !rock.hasWholeWay()};
      }
      return {};
    };
    return computeEach<RockValues>(runs(), rocks_, options_.jobs, compute, progress);
  }

 private:
  Scene& scene_;
  const ConvergenceOptions& options_;
  std::size_t rocks_ = 0;
};

std::vector<PairedSums> sumsByRun(const std::vector<RockValues>& coarse, const std::vector<RockValues>& fine,
                                  std::size_t rocks, std::size_t quantity) {
  std::vector<PairedSums> sums(coarse.size() / rocks);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    sums[i / rocks].coarse += coarse[i].of[quantity];
    sums[i / rocks].fine += fine[i].of[quantity];
  }
  return sums;
}

ConvergedValues meansOf(const std::vector<RockValues>& values) {
  ConvergedValues means{};
  for (const RockValues& value : values)
    for (std::size_t q = 0; q < means.size(); ++q) means[q] += value.of[q] / static_cast<double>(values.size());
  return means;
}

std::size_t cutOffAtSomeStep(const std::vector<std::vector<RockValues>>& values) {
  std::size_t count = 0;
  for (std::size_t rock = 0; rock < values.front().size(); ++rock)
    count += std::ranges::any_of(values, [&](const auto& ofStep) { return ofStep[rock].isCutOff; });
  return count;
}

// The worst of what is said of its quantities: coarse, else undecided, else fine.
void judge(ConvergenceStep& step, double tolerance, std::uint64_t runs, bool judgesRunouts) {
  step.verdict = StepVerdict::fine;
  for (std::size_t q = judgesRunouts ? 0 : kRunout + 1; q < step.differences.size(); ++q) {
    const StepDifference& difference = step.differences[q];
    const StepVerdict one = verdictOf(difference, tolerance);
    if (one == StepVerdict::coarse) step.verdict = one;
    if (one != StepVerdict::undecided) continue;
    if (step.verdict == StepVerdict::fine) step.verdict = one;
    step.runsWanted = std::max(step.runsWanted, runsWanted(difference, tolerance, runs));
  }
  if (step.verdict != StepVerdict::undecided) step.runsWanted = 0;
}

}  // namespace

Status checkConvergence(const Case& description, const ConvergenceOptions& options) {
  if (description.budget.microseconds)
    return Error{
        "/budget/microseconds: runs on a budget of time are never the same twice, so steps cannot be compared: give "
        "\"operations\""};
  if (const std::uint64_t runs = options.runs.last - options.runs.first; runs < kMinConvergenceRuns)
    return Error{fmt::format("{} runs say nothing of how sure an answer is: give --runs at least {}", runs,
                             kMinConvergenceRuns)};
  if (const double finest = stepAt(description.stepS, options.halvings); finest < kShortestStepS)
    return Error{
        fmt::format("/step_s: {:g} s halved {} times is {:g} s, less than the shortest step of {:g} s: give "
                    "fewer --halvings",
                    description.stepS, options.halvings, finest, kShortestStepS)};
  return {};
}

Result<Convergence> converge(Scene& scene, const ConvergenceOptions& options, const ShareDone& progress) {
  if (const Status checked = checkConvergence(scene.description, options); !checked) return checked.error();
  const double coarsest = scene.description.stepS;
  StepRuns steps(scene, options);
  Convergence found;
  found.rocks = steps.rocks() * steps.runs();
  found.runs = steps.runs();
  std::vector<std::vector<RockValues>> values;
  // A step takes about half as long as the next finer one.
  const double all = std::exp2(options.halvings + 1) - 1;
  for (std::uint32_t i = 0; i <= options.halvings; ++i) {
    const double stepS = stepAt(coarsest, i), before = (std::exp2(i) - 1) / all, own = std::exp2(i) / all;
    auto at = steps.at(stepS, [&](double done) { return !progress || progress(before + own * done); });
    scene.description.stepS = coarsest;
    if (!at) return at.error();
    values.push_back(std::move(at).value());
    ConvergenceStep& step = found.steps.emplace_back();
    step.stepS = stepS;
    step.means = meansOf(values.back());
  }
  found.cutOff = cutOffAtSomeStep(values);
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    for (std::size_t q = 0; q < kConvergedNames.size(); ++q)
      found.steps[i].differences[q] =
          differenceOf(sumsByRun(values[i], values.back(), steps.rocks(), q), scene.description.seed + q);
    judge(found.steps[i], options.tolerance, found.runs, found.judgesRunouts());
  }
  for (std::size_t i = values.size() - 1; i-- > 0 && found.steps[i].verdict == StepVerdict::fine;)
    found.fineStepS = found.steps[i].stepS;
  return found;
}

}  // namespace cairn::rockfall
