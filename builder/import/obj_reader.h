// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// The faces of an OBJ, `fo` of old files too; a backslash at its end continues a line, a fourth number of a vertex and
/// no fifth divides it. Everything else is passed over. Errors name the file and the line. Linear.
Result<PolygonSoup> readObj(const std::string& file, std::string_view text);

}  // namespace cairn::builder
