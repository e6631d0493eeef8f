// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "rockfall/convergence/convergence.h"
#include "rockfall/ensemble/run_range.h"

namespace cairn::rockfall {

struct RunCommand {
  std::filesystem::path caseFile, folder;
  RunRange runs, whole;  // of which they are a part
  std::uint32_t jobs = 1;
  std::optional<std::filesystem::path> cache;
};

struct ExplainCommand {
  std::filesystem::path caseFile;
  std::optional<std::filesystem::path> cache, json;
};

struct MergeCommand {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path folder;
  bool png = false, geopackage = false, geojson = false;
};

struct SchemaCommand {};

struct ValidateCommand {
  std::filesystem::path folder;
  std::optional<std::filesystem::path> settings, json, figure, calibrated, cache;
  std::uint32_t jobs = 1, every = 1;
};

struct ConvergeCommand {
  std::filesystem::path caseFile;
  ConvergenceOptions options;
  std::optional<std::filesystem::path> json, cache;
};

using Command = std::variant<RunCommand, ExplainCommand, MergeCommand, SchemaCommand, ValidateCommand, ConvergeCommand>;

/// The command, or the exit code if the program is to end now.
std::variant<Command, int> parseOptions(int argc, const char* const* argv);

}  // namespace cairn::rockfall
