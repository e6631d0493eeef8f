// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace cairn::tool {

/// Splits NAME=VALUE; the name may hold no equals sign. Throws as the parser does.
std::pair<std::string, std::string> namedValue(const char* option, const std::string& text);

/// Adds `--package-path`, for URDFs that name meshes by package: folders by package.
void addPackageOption(CLI::App& command, std::map<std::string, std::filesystem::path>& folders);

}  // namespace cairn::tool
