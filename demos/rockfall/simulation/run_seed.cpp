// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/run_seed.h"

#include <span>

#include "cairn/core/state_hash.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {

std::uint64_t seedOf(std::uint64_t caseSeed, std::string_view caseName, std::uint64_t run, Variable variable) {
  StateHash name;
  name.add(std::as_bytes(std::span(caseName.data(), caseName.size())));
  // mixBits is one-to-one. So for one case, runs below 2^56 cannot share a seed.
  const std::uint64_t ofCase = mixBits(mixBits(caseSeed) + name.value());
  return mixBits(ofCase + (run << 8) + static_cast<std::uint64_t>(variable));
}

}  // namespace cairn::rockfall
