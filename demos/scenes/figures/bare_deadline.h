// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "scenes/figures/quantiles.h"

namespace cairn::scenes {

/// What keeping a deadline costs on this machine when nothing is done: `times` loops in a row that read the clock,
/// about once a microsecond, until `microseconds` have passed. Their CPU time in microseconds, as the scenes measure
/// that of the narrow phase. What is above `microseconds` here no program can avoid: other users of the machine cause
/// it.
Quantiles bareDeadline(double microseconds, std::uint32_t times);

}  // namespace cairn::scenes
