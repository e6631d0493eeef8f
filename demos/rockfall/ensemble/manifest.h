// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "rockfall/case/document.h"
#include "rockfall/ensemble/run_range.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// The description of a folder of runs; it is written before the first of them.
struct Manifest {
  Json document;           ///< the case without comments
  std::string caseFolder;  ///< the file names in the case are relative to it
  std::string caseHash, sceneHash;
  Json versions;
  RunRange asked;  ///< from the first run that was asked for to the last, in this folder and in other parts
};

inline constexpr const char* kManifestName = "manifest.json";

Status writeManifest(const std::filesystem::path& folder, const Manifest& manifest);
/// Reads a folder's manifest. Fails in one sentence that names the folder.
Result<Manifest> readManifest(const std::filesystem::path& folder);

}  // namespace cairn::rockfall
