// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/build.h"
#include "hierarchy/region_tree.h"

namespace cairn::builder {

/// Converts a tree of regions into the records of a sphere-tree. Balls are rounded to float so that they still hold
/// their regions, and errors are certified. Support points, normals and source triangles are collected. Parallel over
/// the nodes; the result does not depend on the number of threads. Precondition: `regions` has at least a root.
/// `SphereTreeData::info` stays unset. `twoSpheres`: see `BuildOptions`.
SphereTreeData makeTreeData(const RegionTree& regions, const SignedDistance& solid, bool twoSpheres);

}  // namespace cairn::builder
