// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// How many of the cases a claim is about decide it, and so what those that were not measured could change.
enum class Reach {
  every,  ///< it is of all: one that fails refutes it, whatever the others do
  some,   ///< it is of any: one that holds proves it
  share,  ///< it is of a part or a mean: the others could turn it either way
};

/// What a claim is about, as far as it can be left out: models, and settings such as methods.
struct Scope {
  Reach reach = Reach::share;         ///< over the models
  std::vector<std::string> models{};  ///< it is about; empty: all of the experiment's
  Reach settingReach = Reach::share;
  std::vector<std::string> lackingSettings{};  ///< it is about and were not measured
};

/// One statement of the thesis, the rule that decides from the data whether it holds here, and what decided it.
struct Claim {
  std::string thesis;                  ///< what the thesis says, one clause; what we say where it is our own
  std::string rule;                    ///< when it counts as found again
  std::string found;                   ///< one clause with figures
  bool holds = false;                  ///< of what was measured
  std::vector<std::string> lacking{};  ///< models it is about that were not measured
  Scope scope{};
  std::optional<double> figure{};  ///< what the rule holds against its limit, where that is one number
  bool isOwn = false;              ///< about what the thesis does not say
};

/// What is known of a claim when something of what it is about was not measured.
enum class Standing { holds, inPart, undecided, fails };
Standing standingOf(const Claim& claim);
/// As the JSON has it.
const char* standingName(Standing standing);
/// How much of what it is about was measured, "only 2 of 6 models measured (without cow, dragon, cone, elephant)";
/// empty where all was.
std::string lackingText(const Claim& claim);
/// Claims with the models they lack: those of `models`, the experiment's, or of their own that are not `measured`.
std::vector<Claim> withLacking(std::vector<Claim> claims, const std::vector<std::string>& models,
                               const std::vector<std::string>& measured);

enum class Verdict { reproduced, inPart, undecided, notReproduced };

/// By the standings of the claims that are the thesis's, of all where none is. No claim: not reproduced.
Verdict verdictOf(const std::vector<Claim>& claims);
/// As the JSON has it. An experiment of our own reproduces nothing: it holds or does not.
const char* verdictName(Verdict verdict, bool isOwn = false);
/// The rule above in one sentence, for readers of the JSON.
inline constexpr const char* kVerdictRule =
    "reproduced (what is our own: holds): every claim holds by its rule, on all models and methods it is about; in "
    "part: some do, or only on those that were measured; not decided: none does, but what was left out could make one "
    "hold; not reproduced: none does. A claim about all is refuted by one model, one about any proved by one; any "
    "other is not decided by fewer than all.";

/// What was found, one sentence for each claim.
std::string foundText(const std::vector<Claim>& claims);
/// How many claims hold, which do not, and which are not decided and why.
std::string whyText(const std::vector<Claim>& claims);

}  // namespace cairn::accuracy_cost
