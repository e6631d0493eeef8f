// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/build.h"
#include "hierarchy/region_tree.h"

namespace cairn::builder {

/// Writes a tree of regions as the records of a sphere-tree: balls rounded to float so that they still hold their
/// regions, errors certified, support points, normals and source triangles gathered. Parallel over the nodes, with one
/// result for any number of threads. `regions` has at least a root. Does not fill in `SphereTreeData::info`.
SphereTreeData makeTreeData(const RegionTree& regions, const SignedDistance& solid);

}  // namespace cairn::builder
