// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/package_paths.h"

#include <fmt/format.h>

#include <vector>

namespace cairn::tool {
std::pair<std::string, std::string> namedValue(const char* option, const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == 0 || at == std::string::npos || at + 1 == text.size())
    throw CLI::ValidationError(option, fmt::format("'{}' is not NAME=VALUE", text));
  return {text.substr(0, at), text.substr(at + 1)};
}

void addPackageOption(CLI::App& command, std::map<std::string, std::filesystem::path>& folders) {
  constexpr const char* kOption = "--package-path";
  const auto read = [&folders](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) folders.insert(namedValue(kOption, text));
  };
  command
      .add_option_function<std::vector<std::string>>(
          kOption, read, "NAME=FOLDER of a ROS package, for package:// (default: a folder NAME in or above the URDF's)")
      ->allow_extra_args(false);
}

}  // namespace cairn::tool
