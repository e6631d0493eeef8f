// SPDX-License-Identifier: GPL-3.0-or-later
#include "advise/take.h"

#include <algorithm>
#include <utility>

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

bool Take::cuts(const std::vector<std::uint32_t>& frames) const {
  return std::ranges::any_of(frames, [&](std::uint32_t frame) { return records_[frame].tree->unresolvedPairs > 0; });
}

scenes::Quantiles Take::timesOf(std::uint32_t run, const std::vector<std::uint32_t>& frames) const {
  std::vector<std::uint32_t> own;
  for (const std::uint32_t frame : frames)
    if (frame / framesPerRun_ == run) own.push_back(frame);
  return stepQuantiles(times_, own);
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
  Rung rung;
  double operations = 0, errors = 0, pairs = 0, unresolved = 0;
  for (const std::uint32_t frame : frames) {
    const bullet::StepStatistics& tree = *records_[frame].tree;
    operations += static_cast<double>(tree.operations);
    errors += tree.meanErrorFraction;
    rung.worstError = std::max(rung.worstError, tree.worstErrorFraction);
    pairs += tree.pairs;
    unresolved += tree.unresolvedPairs;
  }
  const auto count = static_cast<double>(frames.size());
  const scenes::Quantiles quantiles = stepQuantiles(times_, frames);
  rung.budget = budget_.value_or(0);
  rung.cuts = cuts(frames);
  rung.meanOperations = operations / count;
  rung.medianUs = quantiles.median;
  rung.p99Us = quantiles.p99;
  rung.meanError = errors / count;
  rung.p99LowUs = rung.p99HighUs = rung.p99Us;
  for (std::uint32_t run = 0; run * framesPerRun_ < records_.size(); ++run)
    if (const scenes::Quantiles own = timesOf(run, frames); own.max > 0) {
      rung.p99LowUs = std::min(rung.p99LowUs, own.p99);
      rung.p99HighUs = std::max(rung.p99HighUs, own.p99);
    }
  rung.unresolvedPairs = pairs > 0 ? unresolved / pairs : 0;
  return rung;
}

}  // namespace cairn::advise
