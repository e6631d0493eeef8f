// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// Reads the faces of an OBJ, including `fo` of old files. A backslash at the end of a line continues it. A vertex may
/// have a fourth number, which divides the others, if it has no fifth. All other statements are skipped. Errors name
/// the file and the line. Linear.
Result<PolygonSoup> readObj(const std::string& file, std::string_view text);

}  // namespace cairn::builder
