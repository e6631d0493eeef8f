// SPDX-License-Identifier: Zlib
//
// The laws of rock-fall, measured over exact, for rocks from 10 kg to 100 t and steps from 1/60 to 1/1000 s.
#include "laws.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "cairn/core/atomic_file.h"

namespace cairn::bench {
namespace {

using Json = nlohmann::ordered_json;

void printTitle() {
  fmt::print("{:24}{:22}", "measured over exact", "exact");
  for (const btScalar mass : test::kLawMasses)
    for (const btScalar rate : test::kLawRates) fmt::print("{:>15}", fmt::format("{:g} kg 1/{:g}", mass, rate));
  fmt::print("\n");
}

Json run(double& worst) {
  Json rows = Json::array();
  printTitle();
  for (const test::Law& law : test::everyLaw()) {
    fmt::print("{:24}{:22}", law.name, law.quantity);
    for (const btScalar mass : test::kLawMasses)
      for (const btScalar rate : test::kLawRates) {
        const double ratio = law.measure({mass, rate}).ratio();
        worst = std::max(worst, std::abs(ratio - 1));
        fmt::print("{:15.4f}", ratio);
        std::fflush(stdout);
        rows.push_back({{"law", law.name}, {"mass_kg", mass}, {"step_s", 1 / rate}, {"measured_over_exact", ratio}});
      }
    fmt::print("\n");
  }
  fmt::print("farthest from 1: {:.2f} %\n", 100 * worst);
  return rows;
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  CLI::App app("The laws of rock-fall, measured over exact, by mass and step. Exit code 1 if one is off by more.");
  std::string json;
  double most = 0.02, worst = 0;
  app.add_option("--json", json, "write the figures to this file");
  app.add_option("--most", most, "that one may be off, as a part of it")->check(CLI::NonNegativeNumber);
  CLI11_PARSE(app, argc, argv);
  const auto rows = cairn::bench::run(worst);
  if (!json.empty())
    if (const cairn::Status written = cairn::writeFileAtomically(json, rows.dump(2) + "\n"); !written) {
      fmt::print(stderr, "laws_bench: {}\n", written.error().message);
      return 1;
    }
  return worst <= most ? 0 : 1;
}
