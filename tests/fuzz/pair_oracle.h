// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::fuzz {

/// A body whose shape is a tree.
struct TreeBody {
  const bullet::SphereTreeShape* shape = nullptr;
  btTransform pose;
};

/// Whether two such solids (source triangles, margin left out, where their float poses say) are no farther apart than
/// `distance` > 0: by every vertex and, if these leave it open, by every triangle.
bool areWithin(const TreeBody& a, const TreeBody& b, double distance);

/// Where their surfaces cross, the distance from the other's surface of the vertex that is deepest in the other's
/// solid; 0 where they do not. Every triangle is asked.
double depthWhereTheyCross(const TreeBody& a, const TreeBody& b);

}  // namespace cairn::fuzz
