// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btScalar.h>

namespace cairn::bullet {

/// How far ahead in time a step looks, and whether it asks triangles.
struct StepHorizon {
  btScalar timeStep = 0;      ///< seconds
  btScalar sweptTime = 0;     ///< seconds that fast bodies look ahead, see `fastTravel`; 0 for none
  btScalar wallTime = 0;      ///< seconds that bodies near thin walls look ahead, see `wallTravel`
  bool asksTriangles = true;  ///< contacts of leaves are not enough
};

}  // namespace cairn::bullet
