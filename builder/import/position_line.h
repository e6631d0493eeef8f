// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"
#include "import/line_reader.h"

namespace cairn::builder {

/// Reads the next three words of the line as coordinates. They must be finite in single precision, because a tree
/// stores floats.
Result<Vec3d> readPosition(LineReader& line);

}  // namespace cairn::builder
