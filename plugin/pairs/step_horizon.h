// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btScalar.h>

namespace cairn::bullet {

/// How far ahead a step looks, and how closely.
struct StepHorizon {
  btScalar timeStep = 0;      ///< seconds
  btScalar sweptTime = 0;     ///< seconds that fast bodies look ahead, see `fastTravel`; 0: they do not
  btScalar wallTime = 0;      ///< the same of bodies that are fast for thin walls, see `wallTravel`
  bool asksTriangles = true;  ///< what leaves say is not enough
};

}  // namespace cairn::bullet
