// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// The number of cases that decide a claim. It determines what unmeasured cases could change.
enum class Reach {
  every,  ///< the claim is about all cases: one failure refutes it
  some,   ///< the claim is about any case: one success proves it
  share,  ///< the claim is about a part or a mean: unmeasured cases could turn it either way
};

/// The cases of a claim that a run may leave out: models, and settings such as methods.
struct Scope {
  Reach reach = Reach::share;         ///< over the models
  std::vector<std::string> models{};  ///< models of the claim; empty: all of the experiment's
  Reach settingReach = Reach::share;
  std::vector<std::string> lackingSettings{};  ///< settings of the claim that were not measured
};

/// One statement of the thesis, the rule that decides from the data whether it holds here, and the deciding figures.
struct Claim {
  std::string thesis;                  ///< the thesis's statement as one clause; our own statement where `isOwn`
  std::string rule;                    ///< the condition under which the statement counts as reproduced
  std::string found;                   ///< one clause with figures
  bool holds = false;                  ///< for everything that was measured
  std::vector<std::string> lacking{};  ///< models of the claim that were not measured
  Scope scope{};
  std::optional<double> figure{};  ///< the number that the rule compares with its limit, if it is a single one
  bool isOwn = false;              ///< the thesis makes no such statement
};

/// The state of a claim, also when some of its cases were not measured.
enum class Standing { holds, inPart, undecided, fails };
Standing standingOf(const Claim& claim);
/// The name of the standing in the JSON.
const char* standingName(Standing standing);
/// Describes the measured share, for example "only 2 of 6 models measured (without cow, dragon, cone, elephant)"; empty
/// when everything was measured.
std::string lackingText(const Claim& claim);
/// Fills in `lacking` of each claim: the models of the experiment or of the claim itself that are not in `measured`.
std::vector<Claim> withLacking(std::vector<Claim> claims, const std::vector<std::string>& models,
                               const std::vector<std::string>& measured);

enum class Verdict { reproduced, inPart, undecided, notReproduced };

/// Returns the verdict from the standings of the thesis's claims, or of all claims when none is the thesis's. Without
/// claims: not reproduced.
Verdict verdictOf(const std::vector<Claim>& claims);
/// The name of the verdict in the JSON. Our own experiments do not reproduce anything: their names say that they hold
/// or do not hold.
const char* verdictName(Verdict verdict, bool isOwn = false);
/// The rule above in one sentence, for readers of the JSON.
inline constexpr const char* kVerdictRule =
    "reproduced (what is our own: holds): every claim holds by its rule, on all models and methods it is about; in "
    "part: some do, or only on those that were measured; not decided: none does, but what was left out could make one "
    "hold; not reproduced: none does. A claim about all is refuted by one model, one about any proved by one; any "
    "other is not decided by fewer than all.";

/// Returns one sentence of results for each claim.
std::string foundText(const std::vector<Claim>& claims);
/// Says how many claims hold, which do not, and which are undecided and why.
std::string whyText(const std::vector<Claim>& claims);

}  // namespace cairn::accuracy_cost
