// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace cairn::rockfall {

/// SHA-256 of the running program's file, hexadecimal: two builds of one version may simulate differently. Empty where
/// the system does not show it. Cost: reading the file, once.
const std::string& programHash();

}  // namespace cairn::rockfall
