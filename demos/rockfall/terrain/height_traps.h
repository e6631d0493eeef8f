// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "rockfall/terrain/raster.h"

namespace cairn::rockfall {

/// Why a raster can hardly hold heights in metres over a map in metres: numbers that programs write where there is no
/// value, not declared as such; or degrees. What follows a file's name in an error; nothing where all seems well.
std::optional<std::string> whyNoHeights(const Raster& raster);

}  // namespace cairn::rockfall
