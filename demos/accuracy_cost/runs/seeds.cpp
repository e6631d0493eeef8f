// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/runs/seeds.h"

#include <fmt/format.h>

#include <algorithm>

namespace cairn::accuracy_cost {

using Json = nlohmann::ordered_json;

namespace {

Json claimOverSeeds(const std::vector<Json>& documents, std::size_t place) {
  const Json& first = documents.front()["claims"][place];
  Json claim = {{"claim", first["thesis"]}, {"rule", first["rule"]}, {"holds_for_seeds", 0}};
  std::vector<double> figures;
  int holds = 0;
  for (const Json& document : documents) {
    const Json& one = document["claims"][place];
    holds += one["holds"].get<bool>() ? 1 : 0;
    if (one["figure"].is_number()) figures.push_back(one["figure"].get<double>());
  }
  claim["holds_for_seeds"] = holds;
  if (figures.empty()) return claim;
  std::ranges::sort(figures);
  claim["figure_least"] = figures.front();
  claim["figure_median"] = 0.5 * (figures[(figures.size() - 1) / 2] + figures[figures.size() / 2]);
  claim["figure_greatest"] = figures.back();
  return claim;
}

}  // namespace

Json overSeeds(const std::vector<Json>& documents) {
  Json all = {{"experiment", documents.front()["experiment"]}, {"seeds", Json::array()}, {"claims", Json::array()}};
  for (const Json& document : documents) all["seeds"].push_back(document["settings"]["seed"]);
  for (std::size_t i = 0; i < documents.front()["claims"].size(); ++i)
    all["claims"].push_back(claimOverSeeds(documents, i));
  return all;
}

std::string seedsText(const Json& all) {
  std::string text = fmt::format("{}, of {} seeds:\n", all["experiment"].get<std::string>(), all["seeds"].size());
  for (const Json& claim : all["claims"]) {
    text += fmt::format("  {} of {}: {}", claim["holds_for_seeds"].get<int>(), all["seeds"].size(),
                        claim["claim"].get<std::string>());
    if (claim.contains("figure_median"))
      text += fmt::format(" ({:.3g}, from {:.3g} to {:.3g})", claim["figure_median"].get<double>(),
                          claim["figure_least"].get<double>(), claim["figure_greatest"].get<double>());
    text += '\n';
  }
  return text;
}

}  // namespace cairn::accuracy_cost
