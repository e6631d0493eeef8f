// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <variant>

#include "scenes/rockfall/rockfall.h"

namespace cairn::rockfall {

struct Options {
  scenes::RockfallOptions scene;
  std::uint32_t seconds = 20;
  std::uint32_t distinctRocks = 5;
  std::filesystem::path folder = "rockfall-out";
  std::optional<std::filesystem::path> json;
};

/// The options, or the exit code if the program is to end now.
std::variant<Options, int> parseOptions(int argc, const char* const* argv);

}  // namespace cairn::rockfall
