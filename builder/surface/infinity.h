// SPDX-License-Identifier: Zlib
#pragma once

#include <limits>

namespace cairn::builder {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace cairn::builder
