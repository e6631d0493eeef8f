// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "cairn/core/priority.h"
#include "cairn/core/result.h"

namespace CLI {
class App;
}

namespace cairn::scenes {

/// The priorities of the core, see docs/algorithms/priorities.md.
enum class PriorityKind : std::uint8_t { roundRobin, twoClass, worstError, perceptual };

/// round-robin, two-class, worst-error, perceptual. Fails for any other name.
Result<PriorityKind> parsePriority(std::string_view name);

std::unique_ptr<Priority> makePriority(PriorityKind kind);

/// Declares --priority, whose help explains each value. `parsePriority` accepts every parsed `name`. `name` must
/// outlive the parsing.
void addPriorityOption(CLI::App& app, std::string& name);

}  // namespace cairn::scenes
