// SPDX-License-Identifier: Zlib
#include "cairn/core/waiting_line.h"

#include <algorithm>

namespace cairn {

void WaitingLine::begin(std::span<const ScheduledPair> pairs) {
  ++step_;
  records_.follow(pairs);
  order_.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].traversal->done()) {
      records_[i] = {};
      continue;
    }
    if (records_[i].ticket == 0) records_[i] = {nextTicket_++, step_ - 2};
    order_.push_back(i);
  }
  std::sort(order_.begin(), order_.end(), [&](std::size_t l, std::size_t r) { return ticket(l) < ticket(r); });
  next_.assign(pairs.size() + 1, pairs.size());
  previous_.assign(pairs.size() + 1, pairs.size());
  for (const std::size_t pair : order_) append(pair);
}

void WaitingLine::append(std::size_t pair) {
  const std::size_t end = next_.size() - 1, last = previous_[end];
  next_[last] = pair;
  previous_[pair] = last;
  next_[pair] = end;
  previous_[end] = pair;
}

void WaitingLine::turnEnded(std::size_t pair, Progress progress) {
  next_[previous_[pair]] = next_[pair];
  previous_[next_[pair]] = previous_[pair];
  records_[pair] = {nextTicket_++, step_};
  if (progress != Progress::done) append(pair);
}

std::uint64_t WaitingLine::age(std::size_t pair) const {
  const std::uint64_t since = records_[pair].waitingSince;
  return since < step_ ? step_ - since - 1 : 0;
}

}  // namespace cairn
