// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "balls/sphere_set.h"
#include "medial/medial_spheres.h"

namespace cairn::builder {

/// The balls of a region's medial axis from which methods choose or grow a set. Neither list is empty.
struct Candidates {
  std::vector<Ball> covering;  ///< together they hold the region
  std::vector<Ball> all;       ///< includes further balls that may hold much of it once they grow
};

/// Sorts the balls of `medial`. Where it has none, one ball around the problem's points stands for them.
Candidates candidatesFrom(const MedialSpheres& medial, const CoverProblem& problem);

}  // namespace cairn::builder
