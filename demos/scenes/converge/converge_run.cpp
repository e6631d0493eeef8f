// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/converge/converge_run.h"

#include <cassert>
#include <string>
#include <utility>

#include "cairn/builder/progress.h"

namespace cairn::scenes {
namespace {

/// One player and what became of it so far.
struct Entrant {
  Player& player;
  AccuracyJudge judge;
  std::vector<StepRecord> records;
};

/// The frames of one run that are judged.
class CheckedFrames {
 public:
  CheckedFrames(const Recording& recording, std::uint32_t run, std::uint32_t every, const ExactSurface& surface,
                const Model& model)
      : every_(every) {
    for (std::uint32_t frame = 0; frame < recording.framesPerRun; frame += every)
      truths_.emplace_back(surface, model, recording.frame(run, frame));
  }

  bool has(std::uint32_t frame) const { return frame % every_ == 0; }

  void judge(Entrant& entrant, std::size_t firstRecord, const std::vector<std::vector<ReportedContact>>& contacts) {
    for (std::size_t i = 0; i < truths_.size(); ++i)
      entrant.judge.judge(truths_[i], contacts[i], entrant.records[firstRecord + i * every_]);
  }

 private:
  std::uint32_t every_;
  std::vector<FrameTruth> truths_;
};

Status playRun(const Recording& recording, std::uint32_t run, CheckedFrames& checked, Entrant& entrant) {
  if (Status begun = entrant.player.begin(); !begun) return begun;
  const std::size_t firstRecord = entrant.records.size();
  std::vector<std::vector<ReportedContact>> contacts;
  for (std::uint32_t frame = 0; frame < recording.framesPerRun; ++frame) {
    entrant.records.push_back(entrant.player.show(recording.frame(run, frame)));
    if (checked.has(frame)) contacts.push_back(entrant.player.contacts());
  }
  checked.judge(entrant, firstRecord, contacts);
  return {};
}

}  // namespace

Result<std::vector<ConvergeReport>> playRecording(const Recording& recording, const Model& model,
                                                  std::span<const std::unique_ptr<Player>> players,
                                                  std::uint32_t truthEvery, const PlayCallback& afterTurn) {
  assert(truthEvery >= 1);
  const auto surface = ExactSurface::create(model.vertices, model.triangles);
  if (!surface) return surface.error();
  std::vector<Entrant> entrants;
  for (const auto& player : players) entrants.push_back({*player, AccuracyJudge(model.size), {}});
  double turns = 0;
  for (std::uint32_t run = 0; run < recording.runs; ++run) {
    CheckedFrames checked(recording, run, truthEvery, surface.value(), model);
    for (Entrant& entrant : entrants) {
      if (Status played = playRun(recording, run, checked, entrant); !played) return played.error();
      ++turns;
      const double fraction = turns / static_cast<double>(entrants.size() * recording.runs);
      if (afterTurn && !afterTurn(fraction)) return Error{std::string(builder::kCancelled)};
    }
  }
  std::vector<ConvergeReport> reports;
  for (Entrant& entrant : entrants)
    reports.push_back({runCost(entrant.records), entrant.judge.result(), std::move(entrant.records)});
  return reports;
}

}  // namespace cairn::scenes
