// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cairn/core/result.h"

namespace cairn::rockfall {

using Json = nlohmann::json;

/// The value of a JSON text in which // and /* */ comments are allowed. Fails in one sentence that names `file` and the
/// line, or the path of a key given twice, which plain JSON would let pass.
Result<Json> parseDocument(std::string_view text, const std::string& file);

/// The text with control characters as JSON writes them: what a case file says, fit for a sentence.
std::string inOneLine(std::string_view text);

/// One more step of a JSON pointer (RFC 6901).
std::string pathInto(const std::string& path, std::string_view key);
std::string pathInto(const std::string& path, std::size_t index);

}  // namespace cairn::rockfall
