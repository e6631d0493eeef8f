// SPDX-License-Identifier: Zlib
#pragma once

#include <type_traits>

#include "cairn/core/export.h"

namespace cairn {

/// The bits of `from` as another type of the same size: `std::bit_cast`, which the library that comes with Emscripten
/// lacks. GCC 11, Clang 9, MSVC 19.27 and later have the function it is made of. Free.
template <class To, class From>
constexpr To bitCast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
  return __builtin_bit_cast(To, from);
}

}  // namespace cairn
