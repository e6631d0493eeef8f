// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>

namespace cairn::test {

/// How often this program has called `new`. Bullet allocates with functions of its own. Always zero where
/// `countsAllocations` is false.
std::size_t allocations();

/// Whether this program's `new` counts. It does not under the address sanitizer, which has to own `new` itself.
bool countsAllocations();

}  // namespace cairn::test
