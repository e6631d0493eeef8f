// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "accuracy_cost/experiments/experiment.h"
#include "accuracy_cost/models/model.h"

namespace cairn::accuracy_cost {

struct RunCommand {
  std::vector<const Experiment*> experiments;
  std::filesystem::path folder;
  ModelSource models;
  Settings settings;
  std::uint32_t seeds = 1;    ///< number of seeds, counted on from the settings' own
  std::uint32_t threads = 0;  ///< 0: one per core
  bool figures = true, json = false;
};

struct ModelsCommand {
  std::vector<std::string> names;
  ModelSource models;
};

struct ListCommand {};

using Command = std::variant<RunCommand, ModelsCommand, ListCommand>;

/// Returns the command, or the exit code if the program should end now.
std::variant<Command, int> parseOptions(int argc, const char* const* argv);

}  // namespace cairn::accuracy_cost
