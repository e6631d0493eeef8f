// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/build.h"

namespace cairn::builder {

/// Fails for an option out of its range; the error names the option, its value and the range.
Status checkOptions(const BuildOptions& options);

}  // namespace cairn::builder
