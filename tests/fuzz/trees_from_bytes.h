// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bytes.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::fuzz {

/// A point of the surface (tree frame) and a leaf that answers for it: all balls above that leaf hold it too.
struct SurfacePoint {
  Vec3 point;
  NodeId leaf = kRootNode;
};

/// A small tree whose cover and errors hold, and enough of its surface to ask about by brute force. Every ball's error
/// holds of the distance to the points below its own node.
struct KnownTree {
  std::shared_ptr<const SphereTree> tree;
  std::vector<SurfacePoint> surface;
};

/// Trees of small solids with few triangles, made once; a lone root, a flat plate and a thin rod are among them.
std::span<const KnownTree> solidTrees();

/// One of these, or balls around a cloud of points of any size from a billionth to a billion.
KnownTree knownTreeFrom(Bytes& bytes);

/// A tree of a solid with numbers changed that `SphereTree::create` does not check against each other: balls that hold
/// nothing, normals and points of something else, triangles without area. Null where the change was refused.
std::shared_ptr<const SphereTree> damagedTreeFrom(Bytes& bytes);

}  // namespace cairn::fuzz
