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

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

/// The claims that decide the verdict.
std::vector<Standing> standingsThatCount(const std::vector<Claim>& claims) {
  const bool areOwn = std::ranges::all_of(claims, &Claim::isOwn);
  std::vector<Standing> standings;
  for (const Claim& claim : claims)
    if (areOwn || !claim.isOwn) standings.push_back(standingOf(claim));
  return standings;
}

}  // namespace

Standing standingOf(const Claim& claim) {
  const Reach decided = claim.holds ? Reach::some : Reach::every;
  const bool isSettled = (claim.lacking.empty() || claim.scope.reach == decided) &&
                         (claim.scope.lackingSettings.empty() || claim.scope.settingReach == decided);
  if (claim.holds) return isSettled ? Standing::holds : Standing::inPart;
  return isSettled ? Standing::fails : Standing::undecided;
}

const char* standingName(Standing standing) {
  switch (standing) {
    case Standing::holds:
      return "holds";
    case Standing::inPart:
      return "holds in part";
    case Standing::undecided:
      return "not decided";
    default:
      return "does not hold";
  }
}

std::string lackingText(const Claim& claim) {
  std::vector<std::string> texts;
  if (!claim.lacking.empty()) {
    const std::size_t all = std::max(claim.scope.models.size(), claim.lacking.size());
    texts.push_back(fmt::format("only {} of {} models measured (without {})", all - claim.lacking.size(), all,
                                fmt::join(claim.lacking, ", ")));
  }
  if (!claim.scope.lackingSettings.empty())
    texts.push_back(fmt::format("not measured: {}", fmt::join(claim.scope.lackingSettings, ", ")));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::vector<Claim> withLacking(std::vector<Claim> claims, const std::vector<std::string>& models,
                               const std::vector<std::string>& measured) {
  for (Claim& claim : claims) {
    if (claim.scope.models.empty()) claim.scope.models = models;
    for (const std::string& model : claim.scope.models)
      if (!contains(measured, model) && !contains(claim.lacking, model)) claim.lacking.push_back(model);
  }
  return claims;
}

Verdict verdictOf(const std::vector<Claim>& claims) {
  const std::vector<Standing> standings = standingsThatCount(claims);
  const auto are = [&](Standing standing) { return std::ranges::count(standings, standing); };
  if (standings.empty()) return Verdict::notReproduced;
  if (are(Standing::holds) == std::ssize(standings)) return Verdict::reproduced;
  if (are(Standing::holds) + are(Standing::inPart) > 0) return Verdict::inPart;
  return are(Standing::undecided) > 0 ? Verdict::undecided : Verdict::notReproduced;
}

const char* verdictName(Verdict verdict, bool isOwn) {
  switch (verdict) {
    case Verdict::reproduced:
      return isOwn ? "holds" : "reproduced";
    case Verdict::inPart:
      return isOwn ? "holds in part" : "reproduced in part";
    case Verdict::undecided:
      return "not decided";
    default:
      return isOwn ? "does not hold" : "not reproduced";
  }
}

std::string foundText(const std::vector<Claim>& claims) {
  std::vector<std::string> sentences;
  for (const Claim& claim : claims) sentences.push_back(sentence(claim.found));
  return fmt::format("{}", fmt::join(sentences, " "));
}

std::string whyText(const std::vector<Claim>& claims) {
  if (claims.empty()) return "The models at hand leave nothing to compare.";
  const auto is = [](Standing standing) { return [=](const Claim& claim) { return standingOf(claim) == standing; }; };
  std::string text =
      fmt::format("{} of {} claims hold.", std::ranges::count_if(claims, is(Standing::holds)), claims.size());
  for (const Claim& claim : claims)
    if (standingOf(claim) == Standing::fails) text += fmt::format(" Not: {} (rule: {}).", claim.thesis, claim.rule);
  for (const Claim& claim : claims)
    if (standingOf(claim) == Standing::inPart)
      text += fmt::format(" In part: {}; {}.", claim.thesis, lackingText(claim));
  for (const Claim& claim : claims)
    if (standingOf(claim) == Standing::undecided)
      text += fmt::format(" Not decided: {}; {}.", claim.thesis, lackingText(claim));
  return text;
}

}  // namespace cairn::accuracy_cost
