// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../table/hard_case.h"

namespace cairn::hard {

// One file each, named as these are.
HardCase restForAMinute();           // D1
HardCase stackOfTen();               // D2
HardCase massRatio();                // D4
HardCase deepOverlap();              // D5
HardCase wallShots();                // D6
HardCase sphereCountIndependence();  // D15
HardCase budgetStarvation();         // D16

}  // namespace cairn::hard
