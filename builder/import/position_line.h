// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"
#include "import/line_reader.h"

namespace cairn::builder {

/// The next three words of the line as coordinates that are finite in single precision, which is what a tree keeps.
Result<Vec3d> readPosition(LineReader& line);

}  // namespace cairn::builder
