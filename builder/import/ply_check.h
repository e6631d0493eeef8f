// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "cairn/core/result.h"

namespace cairn::builder {

/// Checks that a PLY file has a complete header and all the elements the header promises, in text and in both binary
/// forms. `file` is its name for the message. Linear.
Status checkPly(const std::string& file, std::string_view text);

}  // namespace cairn::builder
