// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cairn::builder {

/// A set of small numbers as machine words: selecting spheres is counting and comparing such sets.
class BitSet {
 public:
  explicit BitSet(std::size_t size = 0) : words_((size + 63) / 64, 0) {}

  void insert(std::size_t i) { words_[i / 64] |= std::uint64_t{1} << (i % 64); }

  std::size_t count() const {
    std::size_t n = 0;
    for (const std::uint64_t w : words_) n += static_cast<std::size_t>(std::popcount(w));
    return n;
  }
  bool empty() const {
    for (const std::uint64_t w : words_)
      if (w != 0) return false;
    return true;
  }
  /// Precondition for both: sets of the same size.
  void remove(const BitSet& other) {
    for (std::size_t k = 0; k < words_.size(); ++k) words_[k] &= ~other.words_[k];
  }
  bool isSubsetOf(const BitSet& other) const {
    for (std::size_t k = 0; k < words_.size(); ++k)
      if ((words_[k] & ~other.words_[k]) != 0) return false;
    return true;
  }

 private:
  std::vector<std::uint64_t> words_;
};

}  // namespace cairn::builder
