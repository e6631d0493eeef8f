// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// Returns the SHA-256 of files in a folder, by name. Files that cannot be read are left out.
nlohmann::ordered_json digestsOf(const std::vector<std::string>& names, const std::filesystem::path& folder);

/// True when each of these files is in the folder and has its digest in `digests`. `digests` may hold anything.
bool areWhole(const std::vector<std::string>& names, const nlohmann::ordered_json& digests,
              const std::filesystem::path& folder);

/// Returns the document with its own digest as `sha256`; an existing one is replaced.
nlohmann::ordered_json sealed(nlohmann::ordered_json document);

/// True when a document is unchanged since it was sealed. False for any value that is no object.
bool isSealed(const nlohmann::ordered_json& document);

}  // namespace cairn::accuracy_cost
