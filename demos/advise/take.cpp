// SPDX-License-Identifier: GPL-3.0-or-later
#include "advise/take.h"

#include <algorithm>
#include <utility>

#include "scenes/world/run_cost.h"

namespace cairn::advise {

scenes::Quantiles stepQuantiles(const std::vector<std::vector<double>>& times,
                                const std::vector<std::uint32_t>& frames) {
  std::vector<double> all;
  for (const std::vector<double>& playing : times)
    for (const std::uint32_t frame : frames) all.push_back(playing[frame]);
  return scenes::quantilesOf(std::move(all));
}

Status Take::play(const scenes::Recording& recording, const scenes::Model& model) {
  scenes::WorldOptions world;
  if (budget_) world.budget.operations = static_cast<std::int64_t>(*budget_);
  framesPerRun_ = recording.framesPerRun;
  const bool isFirst = times_.empty();
  std::vector<double>& times = times_.emplace_back();
  for (std::uint32_t run = 0; run < recording.runs; ++run) {
    const auto player = scenes::makePlayer(model, recording.bodies, world, {});
    if (!player) return player.error();
    for (std::uint32_t frame = 0; frame < recording.framesPerRun; ++frame) {
      scenes::StepRecord record = player.value()->show(recording.frame(run, frame));
      times.push_back(record.narrowPhaseCpuUs);
      if (isFirst) records_.push_back(std::move(record));
    }
  }
  return {};
}

bool Take::cuts() const {
  return std::ranges::any_of(records_,
                             [](const scenes::StepRecord& record) { return record.tree->unresolvedPairs > 0; });
}

std::vector<std::uint32_t> Take::ofRun(std::uint32_t run, const std::vector<std::uint32_t>& frames) const {
  std::vector<std::uint32_t> own;
  for (const std::uint32_t frame : frames)
    if (frame / framesPerRun_ == run) own.push_back(frame);
  return own;
}

double Take::worstError(std::uint32_t run) const {
  double worst = 0;
  for (std::uint32_t frame = run * framesPerRun_; frame < (run + 1) * framesPerRun_; ++frame)
    worst = std::max(worst, records_[frame].tree->worstErrorFraction);
  return worst;
}

void Take::addSpread(Rung& rung, const std::vector<std::uint32_t>& frames) const {
  rung.p99LowUs = rung.p99HighUs = rung.p99Us;
  rung.mildestError = rung.worstError;
  for (std::uint32_t run = 0; run * framesPerRun_ < records_.size(); ++run) {
    rung.mildestError = std::min(rung.mildestError, worstError(run));
    const std::vector<std::uint32_t> own = ofRun(run, frames);
    if (own.empty()) continue;
    const double p99 = stepQuantiles(times_, own).p99;
    rung.p99LowUs = std::min(rung.p99LowUs, p99);
    rung.p99HighUs = std::max(rung.p99HighUs, p99);
  }
}

std::uint64_t Take::mostOperations() const {
  std::uint64_t most = 0;
  for (const scenes::StepRecord& record : records_) most = std::max(most, record.tree->operations);
  return most;
}

std::vector<std::uint32_t> Take::busyFrames() const {
  std::vector<std::uint32_t> frames;
  for (std::uint32_t frame = 0; frame < records_.size(); ++frame)
    if (records_[frame].contacts > 0) frames.push_back(frame);
  return frames;
}

Rung Take::rung(const std::vector<std::uint32_t>& frames) const {
  const scenes::TreeRunStatistics tree = *scenes::runCost(records_).tree;
  const scenes::Quantiles quantiles = stepQuantiles(times_, frames);
  double operations = 0;
  for (const std::uint32_t frame : frames) operations += static_cast<double>(records_[frame].tree->operations);
  Rung rung;
  rung.budget = budget_.value_or(0);
  rung.cuts = cuts();
  rung.meanOperations = operations / static_cast<double>(frames.size());
  rung.medianUs = quantiles.median;
  rung.p99Us = quantiles.p99;
  rung.meanError = tree.meanErrorFraction;
  rung.worstError = tree.maxErrorFraction;
  rung.unresolvedPairs = tree.unresolvedPairFraction;
  addSpread(rung, frames);
  return rung;
}

}  // namespace cairn::advise
