// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rockfall/case/case.h"

namespace cairn::test {

/// The example cases, in the order of their names.
std::vector<std::filesystem::path> exampleFiles();
std::filesystem::path exampleFile(const std::string& name);

/// A small case that is read without complaint, to change things in.
nlohmann::json plainCase();

/// Reads it as the file "case.json" beside the examples.
Result<rockfall::Case> readJson(const nlohmann::json& document);

}  // namespace cairn::test
