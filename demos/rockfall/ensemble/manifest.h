// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rockfall/case/document.h"
#include "rockfall/ensemble/run_range.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// What a folder of finished runs says of itself; written last.
struct Manifest {
  Json document;           ///< the case without comments
  std::string caseFolder;  ///< the files it names are relative to
  std::string caseHash, sceneHash;
  Json versions;
  std::vector<RunRange> runs;
};

inline constexpr const char* kManifestName = "manifest.json";

Status writeManifest(const std::filesystem::path& folder, const Manifest& manifest);
/// Fails in one sentence that names the folder, also where there is none: the folder's runs are not finished.
Result<Manifest> readManifest(const std::filesystem::path& folder);

}  // namespace cairn::rockfall
