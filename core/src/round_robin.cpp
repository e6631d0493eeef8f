// SPDX-License-Identifier: Zlib
#include "cairn/core/round_robin.h"

#include <algorithm>
#include <limits>

namespace cairn {

namespace {
constexpr std::size_t kFinished = std::numeric_limits<std::size_t>::max();
}

void RoundRobin::begin(std::span<const ScheduledPair> pairs) {
  handOutTickets(pairs);
  cursor_ = 0;
  ring_.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!pairs[i].traversal->done()) ring_.push_back(i);
  std::sort(ring_.begin(), ring_.end(), [&](std::size_t l, std::size_t r) {
    const Ticket &left = tickets_[l], &right = tickets_[r];
    return left.wasServed != right.wasServed ? right.wasServed : left.number < right.number;
  });
  interleaveNewcomers();
}

void RoundRobin::interleaveNewcomers() {
  line_.assign(ring_.begin(), ring_.end());
  const auto regulars = std::find_if(line_.begin(), line_.end(), [&](std::size_t i) { return tickets_[i].wasServed; });
  auto fresh = line_.begin(), old = regulars;
  bool freshTurn = newcomersTurn_;
  for (std::size_t& place : ring_) {
    if (fresh == regulars || old == line_.end()) freshTurn = fresh != regulars;
    place = freshTurn ? *fresh++ : *old++;
    freshTurn = !freshTurn;
  }
}

// Who is new stands behind the others who are.
void RoundRobin::handOutTickets(std::span<const ScheduledPair> pairs) {
  tickets_.follow(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (tickets_[i].number == 0) tickets_[i].number = nextTicket_++;
}

std::optional<std::size_t> RoundRobin::next() {
  if (cursor_ == ring_.size()) {
    std::erase(ring_, kFinished);
    cursor_ = 0;
  }
  if (ring_.empty()) return std::nullopt;
  return ring_[cursor_];
}

void RoundRobin::turnEnded(std::size_t pair, Progress progress) {
  newcomersTurn_ = tickets_[pair].wasServed;
  tickets_[pair].number = nextTicket_++;
  tickets_[pair].wasServed = true;
  if (progress == Progress::done) ring_[cursor_] = kFinished;
  ++cursor_;
}

}  // namespace cairn
