// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>

namespace cairn::bullet {

/// Has the machine bring so many bytes into its cache while it works on something else. Changes nothing but time; the
/// address need not be valid.
inline void prefetch([[maybe_unused]] const void* first, [[maybe_unused]] std::size_t bytes) {
#if defined(__GNUC__) || defined(__clang__)
  constexpr std::size_t kCacheLine = 64;
  const auto begin = reinterpret_cast<std::uintptr_t>(first);  // a number: pointers must not leave what they point into
  for (std::size_t at = 0; at < bytes; at += kCacheLine) __builtin_prefetch(reinterpret_cast<const void*>(begin + at));
#endif
}

}  // namespace cairn::bullet
