// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/heap.h"
#include "scenes/tree_source.h"

namespace cairn::frame_budget {

struct Options {
  std::string scene = "heap";
  scenes::TreeSource source;
  std::vector<scenes::ShapeKind> shapes;
  scenes::HeapOptions heap;  ///< its shape is set for each of `shapes` in turn
  std::uint32_t steps = 600;
  std::string priority = "round-robin";
  std::string unresolved = "guard";
  std::optional<std::filesystem::path> json;
  std::optional<std::filesystem::path> csv;
  std::optional<std::filesystem::path> picture;
};

/// The options, or the exit code if the program is to end now (see `parseCommandLine`).
std::variant<Options, int> parseOptions(int argc, const char* const* argv);

}  // namespace cairn::frame_budget
