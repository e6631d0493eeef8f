// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/mesh_paths.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

namespace cairn::builder {
namespace {

namespace fs = std::filesystem;

bool isFile(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

/// `%20` and its like as the characters they stand for (RFC 3986).
std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      result += static_cast<char>(value);
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

Result<fs::path> inPackage(std::string_view rest, const std::string& name, const fs::path& folder,
                           const PackagePaths& packages) {
  const std::string package(rest.substr(0, rest.find('/')));
  const fs::path path(package.size() < rest.size() ? rest.substr(package.size() + 1) : std::string_view());
  if (const auto known = packages.find(package); known != packages.end()) {
    if (isFile(known->second / path)) return known->second / path;
    return Error{
        fmt::format("mesh '{}' is not a file in '{}', the folder given for its package", name, known->second.string())};
  }
  for (fs::path above = folder;; above = above.parent_path()) {
    if (above.filename() == package && isFile(above / path)) return above / path;
    if (isFile(above / package / path)) return above / package / path;
    if (above == above.parent_path()) break;
  }
  return Error{
      fmt::format("mesh '{}': no folder in or above '{}' is package '{}' and holds it; add --package-path "
                  "{}=FOLDER",
                  name, folder.string(), package, package)};
}

std::optional<std::string_view> after(std::string_view scheme, std::string_view name) {
  return name.starts_with(scheme) ? std::optional(name.substr(scheme.size())) : std::nullopt;
}

}  // namespace

Result<fs::path> resolveMesh(const std::string& name, const fs::path& urdf, const PackagePaths& packages) {
  std::error_code none;
  const fs::path folder = fs::weakly_canonical(fs::absolute(urdf, none), none).parent_path();
  for (const char* scheme : {"package://", "model://"})
    if (const auto rest = after(scheme, name)) return inPackage(*rest, name, folder, packages);
  fs::path path = folder / name;
  if (const auto rest = after("file://", name))
    path = decoded(*rest);
  else if (name.find("://") != std::string::npos)
    return Error{fmt::format("mesh '{}' has a scheme that is not read; use package://, file:// or a path", name)};
  if (!isFile(path)) return Error{fmt::format("mesh '{}' is not a file ('{}'); correct its path", name, path.string())};
  return path;
}

}  // namespace cairn::builder
