// SPDX-License-Identifier: Zlib
#include "cairn/bullet/narrow_phase.h"

#include <utility>

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

NarrowPhase::NarrowPhase(btCollisionDispatcher& dispatcher, DispatchThreads threads)
    : NarrowPhase(std::make_shared<Impl>(dispatcher, StepEnd::reported, threads)) {}
NarrowPhase::NarrowPhase(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}
NarrowPhase::NarrowPhase(NarrowPhase&&) noexcept = default;

NarrowPhase::~NarrowPhase() {
  retire();
}

NarrowPhase& NarrowPhase::operator=(NarrowPhase&& other) noexcept {
  if (this == &other) return *this;
  retire();
  impl_ = std::move(other.impl_);
  return *this;
}

void NarrowPhase::retire() {
  if (impl_) impl_->retire();
}

Status NarrowPhase::setBudget(const StepBudget& budget) {
  return impl_->setBudget(budget);
}
Status NarrowPhase::setFrameBudget(const StepBudget& budget) {
  return impl_->setFrameBudget(budget);
}
void NarrowPhase::expectPairs(const ExpectedPairs& pairs) {
  impl_->reserve(countsByKind(pairs));
}
void NarrowPhase::beginFrame(int steps) {
  impl_->beginFrame(steps);
}
void NarrowPhase::setUnresolved(Unresolved policy) {
  impl_->rules().setUnresolved(policy);
}
void NarrowPhase::setFinest(Finest finest) {
  impl_->rules().setFinest(finest);
}
void NarrowPhase::setPriority(std::unique_ptr<Priority> priority) {
  impl_->setPriority(std::move(priority));
}
Status NarrowPhase::setViewer(const std::optional<Viewer>& viewer) {
  return impl_->rules().setViewer(viewer);
}
const StepStatistics& NarrowPhase::lastStep() const {
  return impl_->lastStep();
}
std::vector<PairAnswered> NarrowPhase::lastAnswers() const {
  return impl_->lastAnswers();
}
void NarrowPhase::beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info) {
  impl_->beginStep(pairs, info);
}
void NarrowPhase::endStep() {
  impl_->endStep();
}

}  // namespace cairn::bullet
