// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace cairn::rockfall {

/// Returns the SHA-256 of the running program's file, hexadecimal, because two builds of one version may simulate
/// differently. Empty where the system does not show the file. Cost: the file is read once.
const std::string& programHash();

}  // namespace cairn::rockfall
