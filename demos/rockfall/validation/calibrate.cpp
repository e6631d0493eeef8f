// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/calibrate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/figures/random.h"

namespace cairn::rockfall {
namespace {

constexpr std::size_t kCalibratedProfile = 0;
constexpr double kNarrower = 1.0 / 3;  // of a box in the next round; each holds the best of the one before
constexpr std::uint64_t kBlockStream = 1, kCandidateStream = 1000;

/// The first of all runs in an order drawn by the plan's seed.
std::vector<BlockRun> someRuns(const QuarryScene& quarry, const CalibrationPlan& plan) {
  std::vector<BlockRun> runs = runsOf(quarry, kCalibratedProfile);
  scenes::Random random(plan.seed, kBlockStream);
  const std::size_t count = std::min<std::size_t>(plan.blocks, runs.size());
  for (std::size_t i = 0; i < count; ++i) std::swap(runs[i], runs[i + random.bits() % (runs.size() - i)]);
  runs.resize(count);
  return runs;
}

/// Values with few digits: they are to be read.
double rounded(double value) {
  constexpr double kDigits = 1e4;
  return std::round(value * kDigits) / kDigits;
}

class Search {
 public:
  Search(QuarryScene& quarry, const ValidationSettings& settings, std::uint32_t jobs, const ShareDone& progress)
      : quarry_(quarry),
        settings_(settings),
        jobs_(jobs),
        progress_(progress),
        runs_(someRuns(quarry, settings.calibration)),
        measured_(measuredStops(quarry.data.profiles[kCalibratedProfile])) {
    found_.blocks = static_cast<std::uint32_t>(runs_.size());
  }

  Result<Calibration> run() {
    const CalibrationPlan& plan = settings_.calibration;
    if (const Status tried = attempt({0, valuesOf(settings_), 0}); !tried) return tried.error();
    for (std::uint32_t round = 1; round <= plan.rounds; ++round) {
      const std::vector<double> middle = found_.trials[found_.best].values;
      for (std::uint32_t i = 0; i < plan.candidates; ++i)
        if (const Status tried = attempt({round, candidate(round, i, middle), 0}); !tried) return tried.error();
    }
    return std::move(found_);
  }

 private:
  std::vector<double> candidate(std::uint32_t round, std::uint32_t number, const std::vector<double>& middle) const {
    const CalibrationPlan& plan = settings_.calibration;
    scenes::Random random(plan.seed, kCandidateStream * round + number);
    std::vector<double> values;
    for (std::size_t i = 0; i < plan.parameters.size(); ++i) {
      const auto [low, high] = plan.parameters[i].range;
      const double half = (high - low) / 2 * std::pow(kNarrower, round - 1);
      // A box that would reach beyond the range is moved into it.
      const double center = std::clamp(middle[i], low + half, high - half);
      values.push_back(rounded(random.uniform(center - half, center + half)));
    }
    return values;
  }

  Status attempt(Trial trial) {
    auto changed = withValues(settings_, trial.values);
    if (!changed) return changed.error();
    useSettings(quarry_, changed.value());
    const auto all = static_cast<double>(settings_.calibration.candidates * settings_.calibration.rounds + 1);
    const auto before = static_cast<double>(found_.trials.size());
    const auto ends = simulateBlocks(quarry_, runs_, jobs_,
                                     [&](double done) { return !progress_ || progress_((before + done) / all); });
    if (!ends) return ends.error();
    trial.misfit = misfitOf(stopsOf(quarry_.data.profiles[kCalibratedProfile], ends.value()), measured_);
    found_.trials.push_back(std::move(trial));
    if (found_.trials.back().misfit < found_.trials[found_.best].misfit) found_.best = found_.trials.size() - 1;
    return {};
  }

  QuarryScene& quarry_;
  const ValidationSettings& settings_;
  std::uint32_t jobs_;
  const ShareDone& progress_;
  std::vector<BlockRun> runs_;
  Stops measured_;
  Calibration found_;
};

}  // namespace

double misfitOf(const Stops& simulated, const Stops& measured) {
  return wasserstein(simulated.runoutM, measured.runoutM) / measured.runoutM.middleHalf() +
         wasserstein(simulated.lateralM, measured.lateralM) / measured.lateralM.middleHalf();
}

Result<Calibration> calibrate(QuarryScene& quarry, const ValidationSettings& settings, std::uint32_t jobs,
                              const ShareDone& progress) {
  const Stops measured = measuredStops(quarry.data.profiles[kCalibratedProfile]);
  if (measured.runoutM.empty() || !(measured.runoutM.middleHalf() > 0) || !(measured.lateralM.middleHalf() > 0))
    return Error{quarry.data.folder.string() +
                 " does not say where enough blocks of P1 stopped to calibrate by: add Endpoints_P1.txt"};
  auto found = Search(quarry, settings, jobs, progress).run();
  useSettings(quarry, settings);
  return found;
}

}  // namespace cairn::rockfall
