// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace cairn::rockfall {

/// What a random number is for. Each family has seeds of its own, so that one more number of one family shifts no
/// other.
enum class Variable : std::uint8_t { variant, size, place, orientation, effects };

/// The seed of a family of numbers in one run: a pure function of its arguments, each of which reaches every bit.
std::uint64_t seedOf(std::uint64_t caseSeed, std::string_view caseName, std::uint64_t run, Variable variable);

}  // namespace cairn::rockfall
