// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// By name, SHA-256 of files in a folder; of what cannot be read nothing.
nlohmann::ordered_json digestsOf(const std::vector<std::string>& names, const std::filesystem::path& folder);

/// Whether each of these files is in the folder and has the digest it has in `digests`, whatever that holds.
bool areWhole(const std::vector<std::string>& names, const nlohmann::ordered_json& digests,
              const std::filesystem::path& folder);

/// The document with its own digest as `sha256`, instead of any it has.
nlohmann::ordered_json sealed(nlohmann::ordered_json document);

/// Whether nothing of a document changed since it was sealed. False for what is no object.
bool isSealed(const nlohmann::ordered_json& document);

}  // namespace cairn::accuracy_cost
