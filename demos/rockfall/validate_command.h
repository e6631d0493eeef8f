// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/result.h"
#include "options.h"

namespace cairn::rockfall {

Status validate(const ValidateCommand& command);

}  // namespace cairn::rockfall
