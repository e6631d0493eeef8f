// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flat/flat_problem.h"

namespace cairn::builder {

/// A set that covers the surface with less volume outside the solid than `start`, whose stand-offs are as even as a
/// search for the least worst one leaves them. Ball by ball, the place is looked for where the points only that ball
/// covers cost least volume nobody else covers; then balls the others can do without are set down again where one ball
/// wastes most, as long as that gains. Volumes are counted by samples of the layer outside. Radii are those needed for
/// the points; balls may be fewer than in `start`. Deterministic.
SphereSet leastExcess(const FlatProblem& problem, const FlatPoints& points, SphereSet start);

}  // namespace cairn::builder
