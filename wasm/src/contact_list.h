// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "simulation.h"

namespace cairn::wasm {

/// Numbers of one contact in the list, in this order: point (3, world), normal (3, unit, from b to a), depth (positive
/// where surfaces overlap), certified error (m), a, b, impulse along the normal (N s), 1 where source triangles were
/// measured. Bodies are numbers; planes and boxes are negative.
inline constexpr std::size_t kContactNumbers = 12;

/// The contacts that the last step gave to the solver, appended to `list`.
void listContacts(const Simulation& simulation, std::vector<float>& list);

}  // namespace cairn::wasm
