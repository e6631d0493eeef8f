// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cairn/core/result.h"

namespace cairn::builder {

/// Folders of ROS packages by name.
using PackagePaths = std::map<std::string, std::filesystem::path>;

/// The file that a URDF names. `package://NAME/PATH` (`model://` alike) is sought in the folder given for the package,
/// else in folders NAME in or above the URDF's folder; `file://` holds an absolute path; other paths are relative to
/// the URDF's folder. Fails where there is no such file.
Result<std::filesystem::path> resolveMesh(const std::string& name, const std::filesystem::path& urdf,
                                          const PackagePaths& packages);

}  // namespace cairn::builder
