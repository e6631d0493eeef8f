// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "refit_binding.h"
#include "thickness_samples.h"

namespace cairn {

/// A face's middle and the place that a way straight inwards left the body by, while its vertices were where they were
/// at first.
struct FacingPlaces {
  FixedPlace from, to;
};

/// Those of the faces that `surfaceThickness` looks through; faces without an opposite are left out.
std::vector<FacingPlaces> facingPlaces(const SphereTree& tree);

/// `TreeSurface::thickness` from how far they are apart now, and from the areas of their faces now.
float thicknessOf(const SphereTree& tree, std::span<const FacingPlaces> places, std::vector<ThicknessSample>& samples);

}  // namespace cairn
