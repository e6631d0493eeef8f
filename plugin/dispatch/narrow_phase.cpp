// SPDX-License-Identifier: Zlib
#include "cairn/bullet/narrow_phase.h"

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

NarrowPhase::NarrowPhase(btCollisionDispatcher& dispatcher) : impl_(std::make_unique<Impl>(dispatcher)) {}
NarrowPhase::~NarrowPhase() = default;

Status NarrowPhase::setBudget(const StepBudget& budget) {
  return impl_->setBudget(budget);
}
void NarrowPhase::setUnresolved(Unresolved policy) {
  impl_->setUnresolved(policy);
}
void NarrowPhase::setPriority(std::unique_ptr<Priority> priority) {
  impl_->setPriority(std::move(priority));
}
Status NarrowPhase::setViewer(const std::optional<Viewer>& viewer) {
  return impl_->setViewer(viewer);
}
const StepStatistics& NarrowPhase::lastStep() const {
  return impl_->lastStep();
}
void NarrowPhase::beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info) {
  impl_->beginStep(pairs, info);
}
void NarrowPhase::endStep() {
  impl_->endStep();
}

}  // namespace cairn::bullet
