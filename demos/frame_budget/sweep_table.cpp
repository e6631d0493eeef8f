// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace cairn::frame_budget {
namespace {

using Json = nlohmann::ordered_json;

/// A column of the printed table: one or two figures, scaled.
struct Column {
  const char* title;
  int width;
  std::vector<const char*> figures;  // JSON pointers
  double scale = 1;
  int digits = 2;
};

const std::array kColumns{
    Column{"scene", 9, {"/scene"}},
    Column{"bodies", 7, {"/bodies"}},
    Column{"shape", 15, {"/shape"}},
    Column{"method", 10, {"/tree/method"}},
    Column{"margin", 7, {"/margin_fraction"}},
    Column{"contact error", 14, {"/max_contact_error_fraction"}},
    Column{"ops", 8, {"/budget_ops"}},
    Column{"us", 7, {"/budget_us"}},
    Column{"priority", 12, {"/priority"}},
    Column{"unresolved", 11, {"/unresolved"}},
    Column{"narrow phase ms: 50 / 99 / 99.9 %",
           34,
           {"/narrow_phase_cpu_us/median", "/narrow_phase_cpu_us/p99", "/narrow_phase_cpu_us/p999"},
           1e-3,
           3},
    Column{"certified %", 12, {"/certified_error_fraction/mean"}, 100},
    Column{"true %: mean/max", 17, {"/contact_error_fraction/mean", "/contact_error_fraction/max"}, 100},
    Column{"missed/false", 13, {"/missed_pairs", "/false_pairs_gap_fraction/pairs"}},
    Column{"deep %", 8, {"/penetration_end_fraction/max"}, 100},
    Column{"gap %", 7, {"/gap_end_fraction/mean"}, 100},
    Column{"jitter mm/s", 12, {"/jitter_m_per_s"}, 1000},
    Column{"mJ/kg", 8, {"/kinetic_energy_end_j_per_kg"}, 1000, 3},
    Column{"diverged %: 1 s/end", 20, {"/divergence_1s_fraction", "/divergence_end_fraction"}, 100, 1},
};

std::string figure(const Json& row, const char* pointer, const Column& column) {
  const Json::json_pointer place(pointer);
  if (!row.contains(place) || row.at(place).is_null()) return "-";
  const Json& value = row.at(place);
  if (value.is_string()) return value.get<std::string>();
  if (column.scale == 1) return fmt::format("{:g}", value.get<double>());
  return fmt::format("{:.{}f}", value.get<double>() * column.scale, column.digits);
}

using Cells = std::vector<std::pair<std::string, std::string>>;

/// Adds single values and, under names joined by underscores, the values of groups. Lists stay in the JSON only.
void flatten(const Json& object, const std::string& prefix, Cells& cells) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix.empty() ? key : prefix + "_" + key;
    if (value.is_object())
      flatten(value, name, cells);
    else if (value.is_string())
      cells.emplace_back(name, value.get<std::string>());
    else if (!value.is_array())
      cells.emplace_back(name, value.is_null() ? std::string() : value.dump());
  }
}

/// The name of a mesh may hold separators.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string escaped = "\"";
  for (const char c : text) escaped += c == '"' ? std::string("\"\"") : std::string(1, c);
  return escaped + "\"";
}

}  // namespace

void printSweepHead(const Json& row) {
  fmt::print("{}, 1 m across, seed {}; errors in % of size\n", row.at("mesh").get<std::string>(),
             row.at("seed").get<std::uint64_t>());
  for (const Column& column : kColumns) fmt::print("{:<{}}", column.title, column.width + 1);
  fmt::print("\n");
}

void printSweepRow(const Json& row) {
  for (const Column& column : kColumns) {
    std::vector<std::string> figures;
    for (const char* pointer : column.figures) figures.push_back(figure(row, pointer, column));
    fmt::print("{:<{}}", fmt::format("{}", fmt::join(figures, " / ")), column.width + 1);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

std::string sweepCsv(const std::vector<Json>& rows) {
  std::vector<Cells> lines;
  std::vector<std::string> names;
  for (const Json& row : rows) {
    lines.emplace_back();
    flatten(row, "", lines.back());
    for (const auto& [name, value] : lines.back())
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  std::string text = fmt::format("{}\n", fmt::join(names, ","));
  for (const Cells& line : lines) {
    std::vector<std::string> values;
    for (const std::string& name : names) {
      const auto cell = std::ranges::find(line, name, &std::pair<std::string, std::string>::first);
      values.push_back(cell == line.end() ? std::string() : quoted(cell->second));
    }
    text += fmt::format("{}\n", fmt::join(values, ","));
  }
  return text;
}

}  // namespace cairn::frame_budget
