// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "flat/flat_cover.h"

namespace cairn::builder {

/// A cover of so many spheres.
using MakeCover = std::function<Result<Cover>(std::uint32_t count, Effort effort)>;

/// The cover with the fewest spheres found that keeps the error: doubles and halves their number with little effort,
/// then looks around what that found with all effort. Fails when `kMaxCoverSpheres` do not keep it; the sentence names
/// the mesh.
Result<Cover> fewestSpheres(double maxError, Objective objective, const std::string& meshName, const MakeCover& make);

}  // namespace cairn::builder
