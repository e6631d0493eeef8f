// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/package_paths.h"

#include <fmt/format.h>

namespace cairn::tool {
namespace {

constexpr const char* kOption = "--package-path";

}  // namespace

std::pair<std::string, std::string> namedValue(const char* option, const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == 0 || at == std::string::npos || at + 1 == text.size())
    throw CLI::ValidationError(option, fmt::format("'{}' is not NAME=VALUE", text));
  return {text.substr(0, at), text.substr(at + 1)};
}

void addPackageOption(CLI::App& command, std::vector<std::string>& packages) {
  command
      .add_option(kOption, packages,
                  "NAME=FOLDER of a ROS package, for package:// (default: a folder NAME in or above the URDF's)")
      ->allow_extra_args(false);
}

std::map<std::string, std::filesystem::path> packagesOf(const std::vector<std::string>& packages) {
  std::map<std::string, std::filesystem::path> folders;
  for (const std::string& text : packages) {
    const auto [name, folder] = namedValue(kOption, text);
    folders[name] = folder;
  }
  return folders;
}

}  // namespace cairn::tool
