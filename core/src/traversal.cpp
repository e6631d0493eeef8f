// SPDX-License-Identifier: Zlib
#include "cairn/core/traversal.h"

#include <algorithm>

namespace cairn {

namespace {
float worstOf(std::span<const NodePair> pairs, const Traversal& traversal) {
  float worst = 0;
  for (const NodePair& pair : pairs) worst = std::max(worst, traversal.pairError(pair));
  return worst;
}
}  // namespace

float Traversal::worstError() const {
  return std::max(worstOf(front(), *this), worstOf(leafPairs(), *this));
}

float Traversal::worstFrontError() {
  const std::span<const NodePair> pairs = queue_.pairs();
  for (seen_ = std::max(seen_, head_); seen_ < pairs.size(); ++seen_) {
    const float error = pairError(pairs[seen_]);
    while (peaks_.size() > firstPeak_ && peaks_.back().error <= error) peaks_.pop_back();
    peaks_.push_back({seen_, error});
  }
  while (firstPeak_ < peaks_.size() && peaks_[firstPeak_].place < head_) ++firstPeak_;
  return firstPeak_ < peaks_.size() ? peaks_[firstPeak_].error : 0;
}

void Traversal::forgetErrors() {
  peaks_.clear();
  firstPeak_ = 0;
  seen_ = 0;
}

void Traversal::clear() {
  queue_.clear();
  leafPairs_.clear();
  head_ = 0;
  forgetErrors();
}

}  // namespace cairn
