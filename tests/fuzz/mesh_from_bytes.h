// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bytes.h"
#include "cairn/builder/build.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::fuzz {

/// One of a few solids, some hundred triangles at most, with what damage the bytes ask for: triangles left out, twice
/// there or turned, vertices joined, split or moved, the whole flattened, scaled, moved far, joined with itself, a
/// number made not a number.
builder::TriangleMesh meshFrom(Bytes& bytes);

/// Any method and treatment, small enough for milliseconds; now and then a number out of range.
builder::BuildOptions optionsFrom(Bytes& bytes);

}  // namespace cairn::fuzz
