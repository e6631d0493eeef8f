// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace cairn::tool {

/// `cairn certify` for a robot and the URDF that holds its spheres: prints what is proved of each link, and writes it
/// as JSON where `json` is not empty. Returns the exit code, 1 where a link's surface is left out.
int certifyRobotCommand(const std::string& urdf, const std::string& spheres,
                        const std::map<std::string, std::filesystem::path>& packages, const std::string& json,
                        unsigned threads);

}  // namespace cairn::tool
