// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "hard_case.h"

namespace cairn::hard {

/// Whether docs/hard-cases.md tells that this measure of the case misses when so much of it is run.
bool isKnownMiss(const std::string& id, const std::string& measure, Effort effort);

/// Whether the measure misses and is not known to, or by more than is known: something has become worse.
bool isNews(const std::string& id, const Measure& measure, Effort effort);

}  // namespace cairn::hard
