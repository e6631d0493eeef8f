// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cairn::tool {

/// Splits NAME=VALUE; the name may hold no equals sign. Throws as the parser does.
std::pair<std::string, std::string> namedValue(const char* option, const std::string& text);

/// Adds `--package-path`, for URDFs that name meshes by package.
void addPackageOption(CLI::App& command, std::vector<std::string>& packages);
/// The folders of that option by package. Throws as the parser does.
std::map<std::string, std::filesystem::path> packagesOf(const std::vector<std::string>& packages);

}  // namespace cairn::tool
