// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "cairn/effects/effect.h"
#include "cairn/effects/ground_height.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// Makes the effect at index `place` of a case's list, for one run. Random numbers depend on case and run; positions of
/// single trees depend on the case alone. `ground` must outlive the effect.
std::unique_ptr<effects::Effect> makeEffect(const Scene& scene, std::size_t place, std::uint64_t run,
                                            const effects::GroundHeight& ground);

/// Fails, in one sentence with the path, when a stand of trees has more stems than can be stored.
Status checkStands(const Case& description, const Ground& ground);

}  // namespace cairn::rockfall
