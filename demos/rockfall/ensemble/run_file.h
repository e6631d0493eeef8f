// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "rockfall/case/document.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall {

/// A finished run as a JSON file: its result, its cost and its scene. Numbers are read back as the same doubles.
struct RunFile {
  std::string sceneHash;
  Json versions;  ///< of the program that computed it
  RunResult result;
  RunCost cost;
  std::string resultHash;  ///< SHA-256 of the result alone, hexadecimal
};

/// Returns the versions on which runs depend beside their scene. Runs of different versions are not merged.
Json versionsOfThisProgram();

/// Returns a name such as run-000000042.json. The order of names is the order of numbers.
std::string runFileName(std::uint64_t run);

/// Writes the file completely or not at all. Its content is on disk before it gets its name.
Status writeRunFile(const std::filesystem::path& folder, const std::string& sceneHash, const FinishedRun& run);

/// Reads a run file. Fails in one sentence with its name when it is missing, is no run file, or was changed after it
/// was written.
Result<RunFile> readRunFile(const std::filesystem::path& file);

}  // namespace cairn::rockfall
