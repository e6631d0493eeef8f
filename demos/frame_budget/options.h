// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/command/tree_source.h"
#include "scenes/converge/converge.h"
#include "scenes/heap/heap.h"

namespace cairn::frame_budget {

enum class Scene : std::uint8_t {
  heap,      ///< bodies dropped in a column into a pit
  crush,     ///< bodies that start deep inside each other, in the same pit
  converge,  ///< recorded poses of bodies that fly to one point, played for each shape
  rockfall,  ///< bodies released above a slope
};

const char* sceneName(Scene scene);

struct Options {
  Scene scene = Scene::heap;
  scenes::TreeSource source;
  std::vector<scenes::ShapeKind> shapes;
  scenes::HeapOptions heap;          ///< its shape is set to each of `shapes` in turn
  std::uint32_t steps = 600;         ///< frames per run in `converge`
  scenes::ConvergeOptions converge;  ///< bodies, frames and seed as in `heap` and `steps`
  std::uint32_t truthEvery = 10;     ///< frames between two checks of `converge`
  int threads = 1;                   ///< of the narrow phase
  std::string priority = "round-robin";
  std::string unresolved = "guard";
  std::optional<std::filesystem::path> json;
  std::optional<std::filesystem::path> csv;
  std::optional<std::filesystem::path> picture;
};

struct Command {
  std::vector<Options> measurements;  ///< one; for a sweep several, each with one shape
  bool isSweep = false;
};

/// Returns the command, or the exit code if the program should end now (see `parseCommandLine`).
std::variant<Command, int> parseOptions(int argc, const char* const* argv);

}  // namespace cairn::frame_budget
