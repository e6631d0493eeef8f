// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "certify/protrusion.h"
#include "surface/signed_distance.h"
#include "volumes/flat_faces.h"
#include "volumes/swept_ball.h"

namespace cairn::bench {

/// The certified error of a swept ball, as a sphere's is defined: the largest distance from the solid to a point of the
/// volume, enclosed from both sides. Mesh frame and unit.
///
/// Branch and bound as in `certifiedProtrusion`, with one thing more. A piece is a part of the core plus a patch of
/// directions times an interval of radii. The core's part is the hull of its corners and the patch lies in the hull of
/// six points, so their sum lies in the hull of the sums. The distance to one flat convex face is convex, hence
/// largest at one of these.
///
/// A part of the core that lies inside, apart from the surface by s, settles all points up to the witness plus s from
/// it, however long it is: thin flush volumes end after some ninety queries, others take hundreds to thousands.
///
/// Precondition: `faces` are those of the solid's mesh. Ends as `tolerance` says.
builder::CertifiedProtrusion volumeProtrusion(const builder::SignedDistance& solid, const FlatFaces& faces,
                                              const SweptBall& volume, const builder::ProtrusionTolerance& tolerance);

}  // namespace cairn::bench
