// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace cairn::fuzz {

/// Ends the run with a sentence, as a fuzzer wants it told.
inline void require(bool condition, const std::string& what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

/// A refusal is one sentence.
inline void requireSentence(const std::string& message) {
  require(!message.empty() && message.find('\n') == std::string::npos, "no single sentence: '" + message + "'");
}

}  // namespace cairn::fuzz
