// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/cover.h"
#include "hierarchy/body_frame.h"

namespace cairn::builder {

/// What a plane does to points. The frame is whoever holds it's.
struct Mirror {
  Vec3d normal;
  double offset = 0;

  double side(const Vec3d& p) const { return dot(normal, p) - offset; }
  Vec3d reflected(const Vec3d& p) const { return p - normal * (2 * side(p)); }
  Vec3d projected(const Vec3d& p) const { return p - normal * side(p); }
  /// The point or its image, whichever is on the positive side.
  Vec3d folded(const Vec3d& p) const { return side(p) < 0 ? reflected(p) : p; }
};

/// The plane in the body's frame.
Mirror intoBody(const MirrorPlane& plane, const BodyFrame& frame);

}  // namespace cairn::builder
