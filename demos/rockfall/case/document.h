// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cairn/core/result.h"

namespace cairn::rockfall {

using Json = nlohmann::json;

/// Returns the value of a JSON text, in which // and /* */ comments are allowed. Fails in one sentence that names
/// `file` and the line. Also fails, with the path, for a repeated key, which plain JSON accepts.
Result<Json> parseDocument(std::string_view text, const std::string& file);

/// Returns the text with control characters escaped as in JSON, so that a case file's text fits into a sentence.
std::string inOneLine(std::string_view text);

/// Returns a JSON pointer (RFC 6901) with one more step.
std::string pathInto(const std::string& path, std::string_view key);
std::string pathInto(const std::string& path, std::size_t index);

}  // namespace cairn::rockfall
