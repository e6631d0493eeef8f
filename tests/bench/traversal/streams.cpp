// SPDX-License-Identifier: Zlib
#include "traversal/streams.h"

#include <bit>

#include "vector_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/streams.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "family-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::bench::HWY_NAMESPACE {

namespace lanes = cairn::HWY_NAMESPACE;

std::uint64_t families(const TraversalCase& c, const Sphere& s) {
  const auto sphere = lanes::inAllLanes(s);
  const Family* const blocks = c.tree->families().data();
  std::uint64_t hits = 0;
  for (const std::uint32_t family : c.families)
    hits += static_cast<std::uint64_t>(std::popcount(lanes::overlapLanes(blocks[family], sphere)));
  return hits;
}

std::uint64_t steps(const TraversalCase& c) {
  const Family* const blocks = c.tree->families().data();
  std::uint64_t hits = 0;
  std::size_t i = 0;
  for (const Move& move : c.moves)
    for (const std::size_t end = i + move.count; i < end; ++i) {
      const Sphere other = c.tree->sphere(c.others[i]);
      const Sphere moved{move.into * other.center, other.radius * move.into.scale + move.margin};
      hits += static_cast<std::uint64_t>(
          std::popcount(lanes::overlapLanes(blocks[c.families[i]], lanes::inAllLanes(moved))));
    }
  return hits;
}

}  // namespace cairn::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::bench {

HWY_EXPORT(families);
HWY_EXPORT(steps);

std::uint64_t streamFamilies(const TraversalCase& c, const Sphere& s) {
  return HWY_DYNAMIC_DISPATCH(families)(c, s);
}

std::uint64_t streamSteps(const TraversalCase& c) {
  return HWY_DYNAMIC_DISPATCH(steps)(c);
}

}  // namespace cairn::bench
#endif  // HWY_ONCE
