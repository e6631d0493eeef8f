// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <optional>

#include "cairn/bullet/frame_budget.h"
#include "cairn/bullet/narrow_phase.h"
#include "cairn/core/priority.h"
#include "pairs/pair_contacts.h"

namespace cairn::bullet {

/// Whether somebody announces the end of a step. If not, pairs are answered as they come: see `open_step.h`.
enum class StepEnd : std::uint8_t { reported, open };

/// The user's settings for the steps of a narrow phase.
class StepRules {
 public:
  explicit StepRules(StepEnd end);

  Status setBudget(const StepBudget& budget);
  Status setFrameBudget(const StepBudget& budget);
  void setUnresolved(Unresolved policy) { policy_ = policy; }
  void setFinest(Finest finest) { finest_ = finest; }
  /// Takes effect at `adoptPriority`, because a user's callback may call this while another priority is at work.
  void setPriority(std::unique_ptr<Priority> priority);
  void adoptPriority();
  Status setViewer(const std::optional<Viewer>& viewer);
  void beginFrame(int steps) { frame_.begin(steps); }
  /// A step has used this much.
  void spend(std::uint64_t operations, double microseconds) { frame_.spend(operations, microseconds); }

  StepEnd end() const { return end_; }
  /// The limits of the present step.
  StepBudget limit() const { return tighter(budget_, frame_.share()); }
  static Budget budgetOf(const StepBudget& limit);
  bool mayBeInterrupted() const;
  bool asksTriangles() const { return finest_ == Finest::triangles; }
  /// Whether pairs are finished while they are in the cache. An open step finishes them when they come, and a step that
  /// goes on to triangles first reserves for the others' leaves.
  bool finishesResolvedAtOnce() const { return end_ == StepEnd::reported && !(asksTriangles() && mayBeInterrupted()); }
  /// In an open step Bullet asks for a pair's points later, and about the poses at that time.
  bool reusesPairs() const { return end_ == StepEnd::reported && asksTriangles(); }
  /// Not with other policies than `guard`: their answers cannot wait.
  bool isPlanned() const { return mayBeInterrupted() && policy_ == Unresolved::guard; }
  AnswerPolicy answerPolicy() const { return {policy_, finest_, mayBeInterrupted()}; }
  /// The policy for a pair that is answered at once and in full.
  AnswerPolicy policyAtOnce() const { return {policy_, finest_, false}; }
  Priority& priority() const { return *priority_; }
  const std::optional<Viewer>& viewer() const { return viewer_; }

 private:
  const StepEnd end_;
  StepBudget budget_;
  FrameBudget frame_;
  bool hasFrameBudget_ = false;
  Unresolved policy_ = Unresolved::guard;
  Finest finest_ = Finest::triangles;
  std::unique_ptr<Priority> priority_, nextPriority_;
  std::optional<Viewer> viewer_;
};

}  // namespace cairn::bullet
