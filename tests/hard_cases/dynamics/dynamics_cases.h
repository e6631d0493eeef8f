// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../table/hard_case.h"

namespace cairn::hard {

// One file each, named as these are.
HardCase restForAMinute();           // D1
HardCase stackOfTen();               // D2
HardCase builtToStand();             // D3
HardCase massRatio();                // D4
HardCase deepOverlap();              // D5
HardCase wallShots();                // D6
HardCase thinRods();                 // D7
HardCase tumbling();                 // D8
HardCase fastSpin();                 // D9
HardCase flatMeshes();               // D10
HardCase ballPit();                  // D11
HardCase heapComesToRest();          // D12
HardCase smallAndLarge();            // D13
HardCase farFromOrigin();            // D14
HardCase sphereCountIndependence();  // D15
HardCase budgetStarvation();         // D16

}  // namespace cairn::hard
