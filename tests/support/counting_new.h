// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>

namespace cairn::test {

/// How often this program has called `new`. Bullet allocates with functions of its own. Always zero under the address
/// sanitizer, which has to own `new` itself.
std::size_t allocations();

}  // namespace cairn::test
