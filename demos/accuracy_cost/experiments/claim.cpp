// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace cairn::accuracy_cost {
namespace {

std::string sentence(std::string clause) {
  if (clause.empty()) return clause;
  clause.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(clause.front())));
  return clause + ".";
}

}  // namespace

Verdict verdictOf(const std::vector<Claim>& claims) {
  const auto held = std::ranges::count_if(claims, &Claim::holds);
  if (held == 0) return Verdict::notReproduced;
  const bool areAll = held == std::ssize(claims) &&
                      std::ranges::all_of(claims, [](const Claim& claim) { return claim.lacking.empty(); });
  return areAll ? Verdict::reproduced : Verdict::inPart;
}

const char* verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::inPart:
      return "reproduced in part";
    default:
      return "not reproduced";
  }
}

std::string foundText(const std::vector<Claim>& claims) {
  std::vector<std::string> sentences;
  for (const Claim& claim : claims) sentences.push_back(sentence(claim.found));
  return fmt::format("{}", fmt::join(sentences, " "));
}

std::string whyText(const std::vector<Claim>& claims) {
  if (claims.empty()) return "The models at hand leave nothing to compare.";
  std::string text = fmt::format("{} of {} claims hold.", std::ranges::count_if(claims, &Claim::holds), claims.size());
  for (const Claim& claim : claims)
    if (!claim.holds) text += fmt::format(" Not: {} (rule: {}).", claim.thesis, claim.rule);
  for (const Claim& claim : claims)
    if (claim.holds && !claim.lacking.empty())
      text += fmt::format(" Without {}, which it names: {}.", fmt::join(claim.lacking, " and "), claim.thesis);
  return text;
}

}  // namespace cairn::accuracy_cost
