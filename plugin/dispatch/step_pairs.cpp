// SPDX-License-Identifier: Zlib
#include "dispatch/step_pairs.h"

#include <algorithm>

#include "dispatch/step_tuning.h"
#include "memory/written_room.h"
#include "pairs/pair_prefetch.h"

namespace cairn::bullet {

void StepPairs::reserve(std::size_t pairs) {
  makeWrittenRoom(pairs_, pairs);
  makeWrittenRoom(newPairs_, pairs);
  makeWrittenRoom(named_, pairs);
  makeWrittenRoom(scheduled_, pairs);
}

// Some may remain of a step that an exception ended.
void StepPairs::clear() {
  for (std::size_t i = 0; i < pairs_.size(); ++i) dismiss(i);
  pairs_.clear();
  scheduled_.clear();
}

void StepPairs::add(TreePair& pair) {
  pair.notes.collectedAt = pairs_.size();
  pairs_.push_back(&pair);
}

void StepPairs::order() {
  std::erase(pairs_, nullptr);
  nameNew();
  named_.clear();
  for (TreePair* const pair : pairs_) named_.push_back({pair->notes.id, pair});
  std::ranges::sort(named_, {}, &Named::id);
  for (std::size_t i = 0; i < named_.size(); ++i) {
    pairs_[i] = named_[i].pair;
    pairs_[i]->notes.collectedAt = i;
    scheduled_.push_back({.id = named_[i].id, .traversal = &nothing_});
  }
}

void StepPairs::nameNew() {
  newPairs_.clear();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (const TreePair* next = after(i, step_tuning::kNamesAhead)) prefetch(*next, PairPart::notes);
    if (pairs_[i]->notes.isUnnamed()) newPairs_.push_back({pairs_[i]->bodies.key(i), pairs_[i]});
  }
  std::ranges::sort(newPairs_, {}, &NewPair::key);
  for (const NewPair& fresh : newPairs_) fresh.pair->notes.id = nextName_++;
}

void StepPairs::prefetchAfter(std::size_t index) const {
  if (const TreePair* pair = after(index, step_tuning::kStatesAhead)) prefetch(*pair, PairPart::state);
  if (const TreePair* pair = after(index, step_tuning::kListsAhead)) prefetch(*pair, PairPart::lists);
  if (const TreePair* pair = after(index, step_tuning::kLeafPairsAhead)) prefetch(*pair, PairPart::leafPairs);
}

std::size_t StepPairs::waiting() const {
  return static_cast<std::size_t>(std::ranges::count_if(pairs_, [](const TreePair* pair) { return pair != nullptr; }));
}

// Unless the pair's own callbacks have destroyed it.
void StepPairs::dismiss(std::size_t index) {
  if (pairs_[index]) pairs_[index]->notes.collectedAt = PairNotes::kNowhere;
  pairs_[index] = nullptr;
  if (index < scheduled_.size()) scheduled_[index].traversal = &nothing_;
}

std::size_t StepPairs::firstFrom(std::uint64_t name) const {
  const auto first = std::ranges::lower_bound(scheduled_, name, {}, &ScheduledPair::id);
  return static_cast<std::size_t>(first - scheduled_.begin());
}

}  // namespace cairn::bullet
