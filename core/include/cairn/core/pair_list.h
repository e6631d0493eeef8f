// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "cairn/core/export.h"

namespace cairn {

/// Two things a traversal found overlapping: a node of tree A, and a node of tree B or an element of an obstacle.
struct NodePair {
  std::uint32_t a = 0;  ///< a node of tree A
  std::uint32_t b = 0;  ///< a node of tree B, or an element of an obstacle

  friend constexpr bool operator==(const NodePair&, const NodePair&) = default;
};
static_assert(sizeof(NodePair) == 8 && std::is_trivially_copyable_v<NodePair>);

/// A growing list of pairs into which a SIMD step may write whole vectors: room is made first, then as many pairs as
/// the vector is long are stored behind the end, then the end moves over those that count.
class PairList {
 public:
  /// Pairs in the list.
  std::size_t size() const { return size_; }
  /// Whether there are none.
  bool empty() const { return size_ == 0; }
  /// All of them, the oldest first. Valid until the list grows.
  std::span<const NodePair> pairs() const { return std::span(storage_).first(size_); }
  /// The first of them. Valid until the list grows.
  const NodePair* data() const { return storage_.data(); }

  /// Keeps the memory.
  void clear() { size_ = 0; }
  /// Frees what is not in use.
  void shrinkToFit() {
    storage_.resize(size_);
    storage_.shrink_to_fit();
  }
  /// Appends one pair. Constant time, amortised.
  void push_back(const NodePair& pair) { *makeRoom(1) = pair, ++size_; }

  /// Where the next `count` pairs may be written; good until the next call. Allocates only when the list grows beyond
  /// what it has ever been, and then by half at least.
  NodePair* makeRoom(std::size_t count) {
    if (storage_.size() - size_ < count) storage_.resize(size_ + size_ / 2 + count);
    return storage_.data() + size_;
  }
  /// Takes what was written up to `end` into the list. Precondition: `end` lies in the room last made.
  void extendTo(const NodePair* end) { size_ = static_cast<std::size_t>(end - storage_.data()); }

 private:
  std::vector<NodePair> storage_;
  std::size_t size_ = 0;
};

}  // namespace cairn
