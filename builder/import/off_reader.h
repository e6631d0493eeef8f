// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// The faces of an OFF with three coordinates at the front of a vertex' line: each vertex and each face on a line of
/// its own, because colours of any number may follow. Nothing for `4OFF` and `nOFF`. Errors name the file and the line.
/// Linear.
Result<std::optional<PolygonSoup>> readOff(const std::string& file, std::string_view text);

}  // namespace cairn::builder
