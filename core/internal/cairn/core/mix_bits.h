// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/core/export.h"

namespace cairn {

/// A bijection of 64 bits in which every bit of the input changes about half of the output's: the finaliser of
/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014). Counter-based random numbers and noise are made of it. It takes a
/// few nanoseconds and has no state.
constexpr std::uint64_t mixBits(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBULL;
  return bits ^ (bits >> 31);
}

}  // namespace cairn
