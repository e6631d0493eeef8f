// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>

namespace cairn::builder {

/// What an exception of a library says, as a part of one of our sentences: CGAL spreads its own over several lines.
inline std::string oneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace cairn::builder
