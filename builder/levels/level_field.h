// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "balls/depth_field.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// Returns the depth field in which balls of about this stand-off (mesh unit, > 0) are fitted to the whole surface. It
/// is the closing of the solid near the surface, or the signed distance where there is no concavity to close. Samples
/// are so fine that a ball's stand-off in the field is within 2 % of its protrusion. A spacing twice as coarse would
/// cost up to 10 %, most for balls with centres outside. Builds at most 100,000 samples. `solid` must outlive the
/// field.
std::unique_ptr<DepthField> fieldNear(const SignedDistance& solid, double standOff);

}  // namespace cairn::builder
