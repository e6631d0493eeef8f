// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>

namespace cairn::bullet {

/// Asks the processor to load so many bytes into its cache in the background. Affects time only; the address need not
/// be valid.
inline void prefetch([[maybe_unused]] const void* first, [[maybe_unused]] std::size_t bytes) {
#if defined(__GNUC__) || defined(__clang__)
  constexpr std::size_t kCacheLine = 64;
  // As a number, because pointers must stay within their object.
  const auto begin = reinterpret_cast<std::uintptr_t>(first);
  for (std::size_t at = 0; at < bytes; at += kCacheLine) __builtin_prefetch(reinterpret_cast<const void*>(begin + at));
#endif
}

}  // namespace cairn::bullet
