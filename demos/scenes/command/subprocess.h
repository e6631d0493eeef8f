// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cairn::scenes {

/// Runs a program from the path, in `folder` if given, and waits for it. Its output and errors go to `log`. Returns its
/// exit code, or a negative error number: -ENOENT for a missing program.
int runCommand(const std::vector<std::string>& command, const std::filesystem::path& log,
               const std::filesystem::path& folder = {});

}  // namespace cairn::scenes
