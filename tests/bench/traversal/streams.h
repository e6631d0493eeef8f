// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "traversal/cases.h"

namespace cairn::bench {

/// The bounds a traversal is held against: its blocks, in its order, through its test, and nothing else. Each returns
/// the number of lanes hit (dead ones are never), so that nothing can be left out. On the instruction set Highway has
/// chosen.
///
/// Every family against one sphere that stays where it is.
std::uint64_t streamFamilies(const TraversalCase& c, const Sphere& s);
/// Every family against its own sphere, moved into the family's frame first: both operations of Eq. 2.1.
std::uint64_t streamSteps(const TraversalCase& c);

}  // namespace cairn::bench
