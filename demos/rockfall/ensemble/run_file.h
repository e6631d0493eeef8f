// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "rockfall/case/document.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall {

/// A finished run as a JSON file: what it gave, what it cost, and of which scene it is. Numbers come back as the same
/// doubles.
struct RunFile {
  std::string sceneHash;
  Json versions;  ///< of the program that computed it
  RunResult result;
  RunCost cost;
  std::string resultHash;  ///< SHA-256 of the result alone, hexadecimal
};

/// What runs depend on beside their scene: runs of different versions are not merged.
Json versionsOfThisProgram();

/// run-000000042.json: sorted by name, they are sorted by number.
std::string runFileName(std::uint64_t run);

/// Completely or not at all, flushed to disk before it has its name.
Status writeRunFile(const std::filesystem::path& folder, const std::string& sceneHash, const FinishedRun& run);

/// Fails in one sentence that names the file, for what is missing, no such file, or not what it was written as.
Result<RunFile> readRunFile(const std::filesystem::path& file);

}  // namespace cairn::rockfall
