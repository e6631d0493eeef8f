// SPDX-License-Identifier: GPL-3.0-or-later
//
// The hard cases as a table: what is asked, what was measured, what Bullet's best own shape does on the same case.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "cairn/core/atomic_file.h"
#include "scenes/command/program.h"
#include "table/known_misses.h"
#include "table/print.h"
#include "table/verdict.h"

namespace cairn::hard {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::vector<std::string> cases;
  bool quick = false, list = false, strict = false;
  std::string json;
};

struct Count {
  std::array<int, 3> ofVerdict{};
  std::size_t measures = 0, behindStock = 0;
  std::vector<std::string> news, noLongerMissed;
  Json rows = Json::array();
};

void runOne(const HardCase& hardCase, Effort effort, Count& count) {
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = hardCase.run(effort);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("{}\n", linesOf(hardCase, outcome, seconds));
  std::fflush(stdout);
  ++count.ofVerdict[std::size_t(verdictOn(outcome))];
  const std::vector<std::string> known = knownMisses(hardCase.id, effort);
  for (const Measure& measure : outcome.measures) {
    const std::string name = hardCase.id + " " + measure.name;
    count.behindStock += holdsBehindStock(measure) ? 1 : 0;
    if (isNews(hardCase.id, measure, effort)) count.news.push_back(name);
    if (verdictOn(measure) == Verdict::holds && std::ranges::count(known, measure.name) > 0)
      count.noLongerMissed.push_back(name);
  }
  count.measures += outcome.measures.size();
  count.rows.push_back(jsonOf(hardCase, outcome, seconds));
}

/// The cases asked for, all when none is named; nothing, after one sentence, if there is no such case.
std::optional<std::vector<HardCase>> chosen(const std::vector<std::string>& ids) {
  std::vector<HardCase> all = allHardCases(), wanted;
  if (ids.empty()) return all;
  for (const std::string& id : ids) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const HardCase& hardCase) { return hardCase.id == id; });
    if (found == all.end()) {
      fmt::print(stderr, "hard_cases: there is no case '{}'; --list names them.\n", id);
      return {};
    }
    wanted.push_back(*found);
  }
  return wanted;
}

int runAll(const Options& options) {
  const auto cases = chosen(options.cases);
  if (!cases) return 2;
  Count count;
  for (const HardCase& hardCase : *cases) {
    if (options.list)
      fmt::print("{:4} {}: {}\n", hardCase.id, hardCase.name, hardCase.criterion);
    else
      runOne(hardCase, options.quick ? Effort::quick : Effort::whole, count);
  }
  if (options.list) return 0;
  fmt::print("{} cases: {} hold, {} as good as Bullet's best shape, {} miss.\n", cases->size(), count.ofVerdict[0],
             count.ofVerdict[1], count.ofVerdict[2]);
  fmt::print("{} of {} measures hold though a shape of Bullet's does better still (~).\n", count.behindStock,
             count.measures);
  if (!count.noLongerMissed.empty())
    fmt::print("Known to miss, but not now: {}.\n", fmt::join(count.noLongerMissed, "; "));
  if (!count.news.empty()) fmt::print("Not known to miss, or not so far: {}.\n", fmt::join(count.news, "; "));
  const int news = options.strict && !count.news.empty() ? 1 : 0;
  if (options.json.empty()) return news;
  const Json document = {{"effort", options.quick ? "quick" : "whole"}, {"cases", count.rows}};
  const Status written = writeFileAtomically(options.json, document.dump(1) + "\n");
  if (!written) fmt::print(stderr, "hard_cases: {}\n", written.error().message);
  return written ? news : 1;
}

}  // namespace
}  // namespace cairn::hard

int main(int argc, char** argv) {
  CLI::App app("Hard cases of builder and plugin: criterion, measured figure, Bullet's best own shape, verdict.");
  cairn::hard::Options options;
  app.add_option("CASE", options.cases, "G1 to G15, D1 to D16, C1, C2, I1, I2, L1, L2 (default: all)");
  app.add_flag("--quick", options.quick, "seconds instead of minutes: shorter and smaller, as the tests run them");
  app.add_flag("--list", options.list, "name the cases and what they ask, run nothing");
  app.add_option("--json", options.json, "write the table to this file");
  app.add_flag(
      "--strict", options.strict,
      "end with 1 where something misses that is not known to miss (table/known_misses.cpp), or misses by more");
  app.footer(
      "\nOf its measures '!' marks what misses or is only as good as a shape of Bullet's, '~' what holds though one "
      "does better."
      "\n\nExamples:\n  hard_cases --quick\n  hard_cases D15 D16 --json starved.json\n  hard_cases --strict");
  if (const auto code = cairn::scenes::parseCommandLine(app, argc, argv)) return *code;
  if (const cairn::Status writable = cairn::checkOutputs({}, {options.json}); !writable)
    return cairn::scenes::refuse("hard_cases", writable.error());
  return cairn::hard::runAll(options);
}
