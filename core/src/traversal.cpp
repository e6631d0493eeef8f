// SPDX-License-Identifier: Zlib
#include "cairn/core/traversal.h"

#include <algorithm>

namespace cairn {

std::span<const NodePair> Traversal::coarseFront() const {
  const std::span<const NodePair> now = front();
  return now.size() <= kCoarsePairs ? now : queue_.pairs().subspan(coarseBegin_, coarseEnd_ - coarseBegin_);
}

void Traversal::noteFront() {
  if (queue_.size() - head_ > kCoarsePairs) return;
  coarseBegin_ = head_;
  coarseEnd_ = queue_.size();
}

float Traversal::worstOf(std::span<const NodePair> pairs) const {
  float worst = 0;
  for (const NodePair& pair : pairs) worst = std::max(worst, pairError(pair));
  return worst;
}

float Traversal::worstError() const {
  return std::max(worstOf(front()), worstOf(leafPairs()));
}

float Traversal::worstFrontError() {
  const std::span<const NodePair> pairs = queue_.pairs();
  for (seen_ = std::max(seen_, head_); seen_ < pairs.size();) {
    const std::size_t end = std::min(seen_ + kChunk, pairs.size());
    const float error = worstOf(pairs.subspan(seen_, end - seen_));
    while (peaks_.size() > firstPeak_ && peaks_.back().error <= error) peaks_.pop_back();
    peaks_.push_back({seen_, end, error});
    seen_ = end;
  }
  while (firstPeak_ < peaks_.size() && peaks_[firstPeak_].end <= head_) ++firstPeak_;
  if (firstPeak_ == peaks_.size()) return 0;
  const Peak& first = peaks_[firstPeak_];
  if (head_ <= first.begin) return first.error;
  const float later = firstPeak_ + 1 < peaks_.size() ? peaks_[firstPeak_ + 1].error : 0;
  return std::max(worstOf(pairs.subspan(head_, first.end - head_)), later);
}

void Traversal::forgetErrors() {
  peaks_.clear();
  firstPeak_ = 0;
  seen_ = 0;
}

void Traversal::abandon() {
  queue_.clear();
  leafPairs_.clear();
  head_ = coarseBegin_ = coarseEnd_ = 0;
  forgetErrors();
}

void Traversal::shrinkToFit() {
  if (done()) {  // refined pairs are never read again
    queue_.clear();
    head_ = coarseBegin_ = coarseEnd_ = 0;
    forgetErrors();
  }
  queue_.shrinkToFit();
  leafPairs_.shrinkToFit();
  peaks_.shrink_to_fit();
}

}  // namespace cairn
