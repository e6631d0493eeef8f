// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "cairn/core/result.h"

namespace cairn::rockfall {

/// Calls `work(0)` to `work(count - 1)`, each in a process of its own that ends with the call, and waits for all. On
/// Linux they end with this process, however it ends. Fails with the sentence of the lowest-numbered failure, or
/// reports that its process was killed.
Status inProcesses(std::uint32_t count, const std::function<Status(std::uint32_t)>& work);

}  // namespace cairn::rockfall
