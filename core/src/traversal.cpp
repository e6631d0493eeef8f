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

float Traversal::worstFrontError() const {
  return worstOf(front(), *this);
}

void Traversal::abandon() {
  queue_.clear();
  leafPairs_.clear();
  head_ = 0;
}

}  // namespace cairn
