// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "cairn/effects/effect.h"
#include "cairn/effects/ground_height.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// The effect a case lists at a place of its list, for one run. What draws numbers draws by case and run; where single
/// trees stand, by the case alone. `ground` must outlive it.
std::unique_ptr<effects::Effect> makeEffect(const Scene& scene, std::size_t place, std::uint64_t run,
                                            const effects::GroundHeight& ground);

/// Whether every stand of trees has a number of stems that can be kept; else one sentence with its path.
Status checkStands(const Case& description, const Ground& ground);

}  // namespace cairn::rockfall
