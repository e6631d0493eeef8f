// SPDX-License-Identifier: Zlib
#include "dispatch/pair_pool.h"

#include <algorithm>

#include "dispatch/step_tuning.h"
#include "pairs/pair_prefetch.h"

namespace cairn::bullet {

TreePair* PairPool::take(ColliderKind kind) {
  std::vector<TreePair*>& idle = idle_[static_cast<std::size_t>(kind)];
  if (idle.empty()) return all_.emplace_back(std::make_unique<TreePair>(kind)).get();
  TreePair* const pair = idle.back();
  idle.pop_back();
  using step_tuning::kIdleAhead;
  if (idle.size() >= kIdleAhead) prefetch(*idle[idle.size() - kIdleAhead], PairPart::state);
  return pair;
}

void PairPool::giveBack(TreePair& pair) {
  pair.reset();
  idle_[static_cast<std::size_t>(pair.kind)].push_back(&pair);
}

PairCounts countsByKind(const ExpectedPairs& pairs) {
  PairCounts counts{};
  const auto set = [&](ColliderKind kind, std::size_t count) { counts[static_cast<std::size_t>(kind)] = count; };
  set(ColliderKind::tree, pairs.trees);
  set(ColliderKind::plane, pairs.planes);
  set(ColliderKind::convex, pairs.convexShapes);
  set(ColliderKind::triangles, pairs.triangleMeshes);
  set(ColliderKind::field, pairs.distanceFields);
  set(ColliderKind::terrain, pairs.terrains);
  return counts;
}

std::size_t PairPool::reserve(const PairCounts& pairs) {
  for (std::size_t kind = 0; kind < pairs.size(); ++kind) {
    idle_[kind].reserve(pairs[kind]);
    while (idle_[kind].size() < pairs[kind])
      idle_[kind].push_back(all_.emplace_back(std::make_unique<TreePair>(static_cast<ColliderKind>(kind))).get());
    for (TreePair* const pair : idle_[kind]) pair->contacts.expectInterruptions();
  }
  return all_.size();
}

bool PairPool::hasTaken() const {
  std::size_t idle = 0;
  for (const std::vector<TreePair*>& ofKind : idle_) idle += ofKind.size();
  return idle < all_.size();
}

std::vector<ServedPair> PairPool::servedPairs() const {
  std::vector<ServedPair> served;
  for (const std::unique_ptr<TreePair>& pair : all_)
    if (pair->handles.served.isKnown()) served.push_back(pair->handles.served);
  std::sort(served.begin(), served.end());
  return served;
}

std::vector<PairAnswered> PairPool::lastAnswers() const {
  std::vector<PairAnswered> answers;
  for (const std::unique_ptr<TreePair>& pair : all_) {
    if (!pair->handles.served.isKnown() || !pair->notes.isReported || pair->isCulled()) continue;
    const PairReport& report = pair->notes.lastReport;
    answers.push_back(
        {pair->bodies.object0(), pair->bodies.object1(), report.isUnresolved, report.contacts, report.errorFraction});
  }
  return answers;
}

void PairPool::endStep() {
  using step_tuning::kStepsToLookAtAll;
  const std::size_t part = steps_++ % kStepsToLookAtAll;
  const auto upTo = [&](std::size_t parts) { return all_.size() * parts / kStepsToLookAtAll; };
  for (std::size_t i = upTo(part); i < upTo(part + 1); ++i)
    if (all_[i]->subject.isKnown()) all_[i]->lookAtRest();  // idle pairs keep memory reserved in advance
}

}  // namespace cairn::bullet
