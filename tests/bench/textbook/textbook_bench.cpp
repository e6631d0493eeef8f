// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of accuracy in time where the answer is known: the textbook's experiments with Bullet's own shapes, hulls
// and sphere-trees of one to three levels, the error and the microseconds a step of each.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cairn/core/atomic_file.h"
#include "textbook_shapes.h"

namespace cairn::bench {
namespace {

using Json = nlohmann::ordered_json;
using test::TextbookResult;
using test::TextbookShapes;

void printTitle(const std::vector<TextbookShapes>& all) {
  fmt::print("{:5}{:28}{:>9}", "", "measured; error; us a step", "exact");
  for (const TextbookShapes& shapes : all) fmt::print("  {:^23}", shapes.name);
  fmt::print("\n");
}

Json run(const std::vector<TextbookShapes>& all) {
  Json rows = Json::array();
  printTitle(all);
  for (const auto& experiment : test::textbook::experiments()) {
    Json row;
    for (const TextbookShapes& shapes : all) {
      const TextbookResult result = experiment(shapes);
      if (row.empty()) {
        row = {{"experiment", result.experiment}, {"quantity", result.quantity}, {"exact", result.exact}};
        fmt::print("{:5}{:28}{:9.3f}", result.experiment, result.quantity, result.exact);
      }
      fmt::print("  {:8.3f} {:6.2f}% {:6.1f}", result.measured, 100 * result.error(), result.microsecondsPerStep);
      std::fflush(stdout);
      row["shapes"][shapes.name] = {
          {"measured", result.measured}, {"error_fraction", result.error()}, {"step_us", result.microsecondsPerStep}};
    }
    fmt::print("\n");
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  CLI::App app("The textbook's experiments: what each shape makes of them, and what it takes.");
  std::string json;
  app.add_option("--json", json, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  const auto rows = cairn::bench::run(cairn::test::textbookShapes());
  if (json.empty()) return 0;
  const cairn::Status written = cairn::writeFileAtomically(json, rows.dump(2) + "\n");
  if (!written) fmt::print(stderr, "textbook_bench: {}\n", written.error().message);
  return written ? 0 : 1;
}
