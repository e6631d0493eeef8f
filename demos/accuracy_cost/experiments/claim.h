// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// One statement of the thesis, the rule that decides from the data whether it holds here, and what decided it.
struct Claim {
  std::string thesis;  ///< what the thesis says, one clause
  std::string rule;    ///< when it counts as found again
  std::string found;   ///< one clause with figures
  bool holds = false;
  std::vector<std::string> lacking{};  ///< models it names that were not measured: `holds` is of the others
};

enum class Verdict { reproduced, inPart, notReproduced };

/// Reproduced when every claim holds on every model it names, in part when some hold. No claim, no verdict: not
/// reproduced.
Verdict verdictOf(const std::vector<Claim>& claims);
/// As the JSON has it.
const char* verdictName(Verdict verdict);
/// The rule above in one sentence, for readers of the JSON.
inline constexpr const char* kVerdictRule =
    "reproduced: every claim holds by its rule, on all models it names; reproduced in part: some do, or not all of "
    "these "
    "models were measured; not reproduced: none does";

/// What was found, one sentence for each claim.
std::string foundText(const std::vector<Claim>& claims);
/// How many claims hold, which do not, and which are of fewer models than they name.
std::string whyText(const std::vector<Claim>& claims);

}  // namespace cairn::accuracy_cost
