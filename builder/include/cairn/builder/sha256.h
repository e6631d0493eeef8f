// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace cairn::builder {

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits. Cannot fail. Linear time.
std::string sha256Hex(std::span<const std::byte> bytes);

}  // namespace cairn::builder
