// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "scenes/figures/quantiles.h"

namespace cairn::scenes {

/// Measures the cost of a deadline on this machine without any work. Runs `times` loops in a row that read the clock,
/// about once a microsecond, until `microseconds` have passed. Returns their CPU time in microseconds, measured like
/// that of the narrow phase. No program can avoid an excess over `microseconds` here: other users of the machine cause
/// it.
Quantiles bareDeadline(double microseconds, std::uint32_t times);

}  // namespace cairn::scenes
