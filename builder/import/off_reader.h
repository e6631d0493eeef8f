// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// Reads the faces of an OFF whose vertex lines begin with three coordinates. Each vertex and each face has its own
/// line, because any number of colours may follow. Nothing for `4OFF` and `nOFF`. Errors name the file and the line.
/// Linear.
Result<std::optional<PolygonSoup>> readOff(const std::string& file, std::string_view text);

}  // namespace cairn::builder
