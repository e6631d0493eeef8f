// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace cairn::tool {

/// Whether a file is to be read as a tree, by its name's ending or because it holds zero bytes, as trees do and texts
/// do not. What cannot be read is none.
bool isTreeFile(const std::string& path);

}  // namespace cairn::tool
