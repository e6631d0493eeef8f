// SPDX-License-Identifier: GPL-3.0-or-later
#include "print.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "verdict.h"

namespace cairn::hard {
namespace {

using Json = nlohmann::ordered_json;

char markOf(const Measure& measure) {
  if (verdictOn(measure) != Verdict::holds) return '!';
  return holdsBehindStock(measure) ? '~' : ' ';
}

std::string withUnit(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{:.4g}", value) : fmt::format("{:.4g} {}", value, unit);
}

const char* signOf(Bound bound) {
  return bound == Bound::atMost ? "<=" : ">=";
}

std::string inWords(const Measure& measure) {
  return measure.name + " " + withUnit(measure.value, measure.unit);
}

std::string stockInWords(const Measure& measure) {
  return fmt::format("{} {} ({})", measure.name, withUnit(measure.stockValue, measure.unit), measure.stock);
}

Json jsonOf(const Measure& measure) {
  Json json = {{"name", measure.name},   {"value", measure.value}, {"bound", signOf(measure.bound)},
               {"limit", measure.limit}, {"unit", measure.unit},   {"verdict", nameOf(verdictOn(measure))}};
  if (measure.stock.empty()) return json;
  json["stock"] = {{"shape", measure.stock}, {"value", measure.stockValue}};
  json["holds_behind_stock"] = holdsBehindStock(measure);
  return json;
}

}  // namespace

std::string linesOf(const HardCase& hardCase, const Outcome& outcome, double seconds) {
  std::string text =
      fmt::format("{:4} {:16} {} ({:.1f} s)\n", hardCase.id, nameOf(verdictOn(outcome)), hardCase.name, seconds);
  text += fmt::format("       {}\n", hardCase.criterion);
  for (const Measure& measure : outcome.measures) {
    text += fmt::format("       {} {:46} {:>18} {} {:<14}", markOf(measure), measure.name,
                        withUnit(measure.value, measure.unit), signOf(measure.bound),
                        withUnit(measure.limit, measure.unit));
    if (!measure.stock.empty())
      text += fmt::format("  {} {}", measure.stock, withUnit(measure.stockValue, measure.unit));
    text += '\n';
  }
  if (!outcome.why.empty()) text += fmt::format("       {}\n", outcome.why);
  return text;
}

Json jsonOf(const HardCase& hardCase, const Outcome& outcome, double seconds) {
  std::string measured, stock;
  Json measures = Json::array();
  for (const Measure& measure : outcome.measures) {
    measured += (measured.empty() ? "" : "; ") + inWords(measure);
    if (!measure.stock.empty()) stock += (stock.empty() ? "" : "; ") + stockInWords(measure);
    measures.push_back(jsonOf(measure));
  }
  return {{"id", hardCase.id},    {"name", hardCase.name}, {"criterion", hardCase.criterion},
          {"measured", measured}, {"stock", stock},        {"verdict", nameOf(verdictOn(outcome))},
          {"why", outcome.why},   {"seconds", seconds},    {"measures", measures}};
}

}  // namespace cairn::hard
