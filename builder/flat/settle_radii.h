// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flat/flat_problem.h"

namespace cairn::builder {

/// The balls with the least radii, or nearly, at which they cover the whole surface, each piece held by the ball that
/// needs the least stand-off for it. Pieces that need more than `standOff` are cut, down to `finest`. Centres stay.
/// Cover can be proved: radii have more to spare than the proof's guard. Preconditions: `balls` not empty, lengths
/// above 0.
SphereSet coveringRadii(SphereSet balls, const TriangleMesh& mesh, double standOff, double finest);

/// The balls made as large as the solid holds them; a centre that does not lie in it goes to the nearest place that
/// does. Radii are above 0. Depths are the solid's afterwards.
SphereSet innerRadii(SphereSet balls, const SignedDistance& solid);

/// Radii at which the worst of what sticks out and what is left out of the surface is as small as these centres allow,
/// from radii that cover it. Radii are above 0. Parallel over balls, deterministic.
SphereSet balancedRadii(SphereSet covering, const SignedDistance& solid, const KeepGoing& keepGoing);

}  // namespace cairn::builder
