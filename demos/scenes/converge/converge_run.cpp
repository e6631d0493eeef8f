// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/converge/converge_run.h"

#include <cassert>
#include <string>
#include <utility>

#include "cairn/builder/progress.h"

namespace cairn::scenes {
namespace {

/// The progress of a recording. In each run, the truth of its frames is one turn, and every player has one.
class Turns {
 public:
  Turns(const PlayCallback& tell, std::size_t count) : tell_(tell), count_(static_cast<double>(count)) {}

  /// False when the work is to end. `inside`: how much of the turn is done.
  bool tell(double inside) const { return !tell_ || tell_((done_ + inside) / count_); }
  void next() { ++done_; }

 private:
  const PlayCallback& tell_;
  double count_, done_ = 0;
};

/// One player and its results so far.
struct Entrant {
  Player& player;
  AccuracyJudge judge;
  std::vector<StepRecord> records;
};

/// The frames of one run that are judged.
class CheckedFrames {
 public:
  explicit CheckedFrames(std::uint32_t every) : every_(every) {}

  /// False when the work is to end.
  bool find(const Recording& recording, std::uint32_t run, const ExactSurface& surface, const Model& model,
            const Turns& turns) {
    truths_.clear();
    for (std::uint32_t frame = 0; frame < recording.framesPerRun; frame += every_) {
      if (!turns.tell(static_cast<double>(frame) / recording.framesPerRun)) return false;
      truths_.emplace_back(surface, model, recording.frame(run, frame));
    }
    return true;
  }

  bool has(std::uint32_t frame) const { return frame % every_ == 0; }

  /// False when the work is to end.
  bool judge(Entrant& entrant, std::size_t firstRecord, const std::vector<std::vector<ReportedContact>>& contacts,
             const Turns& turns) {
    for (std::size_t i = 0; i < truths_.size(); ++i) {
      if (!turns.tell(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(truths_.size()))) return false;
      entrant.judge.judge(truths_[i], contacts[i], entrant.records[firstRecord + i * every_]);
    }
    return true;
  }

 private:
  std::uint32_t every_;
  std::vector<FrameTruth> truths_;
};

Status playRun(const Recording& recording, std::uint32_t run, CheckedFrames& checked, const Turns& turns,
               Entrant& entrant) {
  if (Status begun = entrant.player.begin(); !begun) return begun;
  const std::size_t firstRecord = entrant.records.size();
  std::vector<std::vector<ReportedContact>> contacts;
  for (std::uint32_t frame = 0; frame < recording.framesPerRun; ++frame) {
    if (!turns.tell(0.5 * frame / recording.framesPerRun)) return Error{std::string(builder::kCancelled)};
    entrant.records.push_back(entrant.player.show(recording.frame(run, frame)));
    if (checked.has(frame)) contacts.push_back(entrant.player.contacts());
  }
  if (!checked.judge(entrant, firstRecord, contacts, turns)) return Error{std::string(builder::kCancelled)};
  return {};
}

}  // namespace

Result<std::vector<ConvergeReport>> playRecording(const Recording& recording, const Model& model,
                                                  std::span<const std::unique_ptr<Player>> players,
                                                  std::uint32_t truthEvery, const PlayCallback& progress) {
  assert(truthEvery >= 1);
  const auto surface = ExactSurface::create(model.vertices, model.triangles);
  if (!surface) return surface.error();
  std::vector<Entrant> entrants;
  for (const auto& player : players) entrants.push_back({*player, AccuracyJudge(model.size), {}});
  Turns turns(progress, (entrants.size() + 1) * recording.runs);
  CheckedFrames checked(truthEvery);
  for (std::uint32_t run = 0; run < recording.runs; ++run) {
    if (!checked.find(recording, run, surface.value(), model, turns)) return Error{std::string(builder::kCancelled)};
    turns.next();
    for (Entrant& entrant : entrants) {
      if (Status played = playRun(recording, run, checked, turns, entrant); !played) return played.error();
      turns.next();
    }
  }
  if (!turns.tell(0)) return Error{std::string(builder::kCancelled)};
  std::vector<ConvergeReport> reports;
  for (Entrant& entrant : entrants)
    reports.push_back({runCost(entrant.records), entrant.judge.result(), std::move(entrant.records)});
  return reports;
}

}  // namespace cairn::scenes
