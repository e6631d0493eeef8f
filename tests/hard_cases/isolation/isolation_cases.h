// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../table/hard_case.h"

namespace cairn::hard {

// One file each, named as these are.
HardCase brokenBody();  // I1
HardCase sameBits();    // I2

}  // namespace cairn::hard
