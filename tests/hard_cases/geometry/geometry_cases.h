// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../table/hard_case.h"

namespace cairn::hard {

// One file each, named as these are.
HardCase cosphericalPoints();  // G1
HardCase onOneSphere();        // G2
HardCase duplicateVertices();  // G3
HardCase slivers();            // G4
HardCase flatSolids();         // G5
HardCase tooLittle();          // G6
HardCase openMeshes();         // G7
HardCase nonManifold();        // G8
HardCase crossingAndNested();  // G9
HardCase flippedWinding();     // G10
HardCase brokenFiles();        // G11
HardCase scaleAndPlace();      // G12
HardCase rodsAndPlates();      // G13
HardCase gaps();               // G14
HardCase largeAndStarved();    // G15

}  // namespace cairn::hard
