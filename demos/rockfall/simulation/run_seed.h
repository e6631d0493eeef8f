// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace cairn::rockfall {

/// The use of a random number. Each use has its own seeds, so one more number of one use never shifts those of another.
enum class Variable : std::uint8_t { variant, size, place, orientation, effects, velocity, parameters };

/// Returns the seed of one use in one run: a pure function of its arguments. Each argument affects every bit.
std::uint64_t seedOf(std::uint64_t caseSeed, std::string_view caseName, std::uint64_t run, Variable variable);

}  // namespace cairn::rockfall
