// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "rockfall/convergence/convergence.h"

namespace cairn::rockfall {

std::string convergenceText(const Convergence& found, const Case& description, double tolerance);
/// The same with units in the keys.
std::string convergenceJson(const Convergence& found, const Case& description, double tolerance);

}  // namespace cairn::rockfall
