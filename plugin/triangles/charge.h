// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "cairn/core/budget.h"

namespace cairn::bullet {

/// `Budget::charge` for products of two numbers of triangles, which may be more than it takes at a time: charged as its
/// most, which takes a budget of operations to its end.
inline bool chargeFor(Budget& budget, std::size_t operations) {
  return budget.charge(
      static_cast<std::uint32_t>(std::min<std::size_t>(operations, std::numeric_limits<std::uint32_t>::max())));
}

}  // namespace cairn::bullet
