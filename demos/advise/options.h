// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <variant>

#include "advise/measure.h"

namespace cairn::advise {

struct Options {
  std::filesystem::path mesh;
  Trial trial;
  double budgetUs = 0;  ///< of the narrow phase, per step
  bool all = false;     ///< print every budget of every tree
  unsigned threads = 0;
  std::optional<std::filesystem::path> json, figure;
};

/// Returns the options, or the exit code if the program should end now (see `parseCommandLine`).
std::variant<Options, int> parseOptions(int argc, const char* const* argv);

}  // namespace cairn::advise
