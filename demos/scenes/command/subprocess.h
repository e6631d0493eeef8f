// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cairn::scenes {

/// Runs a program, found on the path, with its output and errors going to `log`, and waits for it. Its exit code, or an
/// error number as a negative one: -ENOENT where there is no such program. With a `folder` it works in that one.
int runCommand(const std::vector<std::string>& command, const std::filesystem::path& log,
               const std::filesystem::path& folder = {});

}  // namespace cairn::scenes
