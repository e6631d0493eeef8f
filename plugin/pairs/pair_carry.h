// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// For a pair that triangles answered: where the bodies have hardly moved against each other since
/// (`tuning::kCarried`), the manifolds' points follow them as they are. Nothing where that does not do. Precondition:
/// the bodies are copied where they are.
std::optional<PairReport> carryOver(TreePair& pair);

}  // namespace cairn::bullet
