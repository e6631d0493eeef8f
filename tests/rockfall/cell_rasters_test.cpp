// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of cells, against all values of each cell kept and sorted here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "prepared_scene.h"
#include "rockfall/outputs/enough_runs.h"
#include "rockfall/outputs/raster_files.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall::cell_rasters_test {
namespace {

using Cell = MergedRuns::Cell;
using Member = double VisitRecord::*;

/// Runs of the plain case, simulated once.
class CellRasters : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scene_ = std::make_unique<Scene>(test::prepared(test::plainCase()));
    merged_ = std::make_unique<MergedRuns>();
    merged_->collectors.resize(scene_->description.collectors.size());
    for (std::uint64_t run = 0; run < kRuns; ++run) {
      runs_.push_back(simulate(*scene_, run).value().result);
      merged_->add(runs_.back(), scene_->description.outputs.rasterCellM);
    }
  }
  static void TearDownTestSuite() {
    merged_.reset();
    scene_.reset();
    runs_.clear();
  }

  static double valueOf(const std::string& name, const Cell& cell) {
    for (const RasterKind& kind : rasterKinds(scene_->description, *merged_))
      if (kind.name == name) return kind.value(merged_->cells.at(cell));
    ADD_FAILURE() << "no raster " << name;
    return 0;
  }
  static std::map<Cell, std::vector<double>> valuesOf(Member member) {
    std::map<Cell, std::vector<double>> values;
    for (const RunResult& run : runs_)
      for (const VisitRecord& visit : run.cells) values[{visit.row, visit.column}].push_back(visit.*member);
    return values;
  }

  static constexpr std::uint64_t kRuns = 200;
  inline static std::unique_ptr<Scene> scene_;
  inline static std::unique_ptr<MergedRuns> merged_;
  inline static std::vector<RunResult> runs_;
};

TEST_F(CellRasters, TellMeansAndQuantilesOfEachQuantity) {
  const std::vector<std::pair<const char*, Member>> quantities{{"energy_{}_j", &VisitRecord::maxEnergyJ},
                                                               {"translation_{}_j", &VisitRecord::maxTranslationJ},
                                                               {"rotation_{}_j", &VisitRecord::maxRotationJ},
                                                               {"speed_{}_m_per_s", &VisitRecord::maxSpeed},
                                                               {"height_{}_m", &VisitRecord::maxHeightM}};
  const auto named = [](std::string pattern, const std::string& figure) {
    return pattern.replace(pattern.find("{}"), 2, figure);
  };
  for (const auto& [pattern, member] : quantities) {
    std::size_t cells = 0;
    for (auto [cell, values] : valuesOf(member)) {
      if (values.size() < 20) continue;  // few enough cells to look at each
      ++cells;
      const double sum = std::accumulate(values.begin(), values.end(), 0.0);
      const auto count = static_cast<double>(values.size());
      EXPECT_NEAR(valueOf(named(pattern, "mean"), cell), sum / count, 1e-9 * std::abs(sum)) << pattern;
      std::ranges::sort(values);
      for (const int percent : {50, 95, 99}) {
        const double exact = values[static_cast<std::size_t>(std::ceil(percent * count / 100)) - 1];
        const double told = valueOf(named(pattern, "p" + std::to_string(percent)), cell);
        EXPECT_GE(told, exact) << pattern << " " << percent;
        EXPECT_LE(told, std::max(0.0, exact) * LogHistogram::kBinRatio * (1 + 1e-12)) << pattern << " " << percent;
      }
      EXPECT_EQ(valueOf(named(pattern, "max"), cell), values.back()) << pattern;
    }
    EXPECT_GT(cells, 5U);
  }
}

TEST_F(CellRasters, PartEnergyIntoTranslationAndRotation) {
  std::size_t spinning = 0;
  for (const RunResult& run : runs_)
    for (const VisitRecord& visit : run.cells) {
      const double mass = run.rocks[visit.rock].massKg, least = std::max(visit.maxTranslationJ, visit.maxRotationJ);
      constexpr double kFloat = 1e-6;  // of a mass and a speed in single precision
      EXPECT_NEAR(visit.maxTranslationJ, mass * visit.maxSpeed * visit.maxSpeed / 2, kFloat * visit.maxTranslationJ);
      EXPECT_GE(visit.maxEnergyJ, least);
      EXPECT_LE(visit.maxEnergyJ, (visit.maxTranslationJ + visit.maxRotationJ) * (1 + 1e-12));
      spinning += visit.maxRotationJ > 0.01 * visit.maxEnergyJ;
    }
  EXPECT_GT(spinning, 100U) << "rocks tumble down a slope";
}

TEST_F(CellRasters, BoundTheQuantileWhereThereAreRocksEnough) {
  std::size_t told = 0, unknown = 0;
  for (const auto& [cell, values] : valuesOf(&VisitRecord::maxEnergyJ)) {
    const double p95 = valueOf("energy_p95_j", cell), high = valueOf("energy_p95_high_j", cell);
    EXPECT_LE(valueOf("energy_p95_low_j", cell), p95);
    EXPECT_EQ(std::isnan(high), values.size() < 72) << "0.95^72 is below one in forty, of " << values.size();
    if (std::isnan(high))
      ++unknown;
    else if (++told > 0)
      EXPECT_GE(high, p95);
  }
  EXPECT_GT(told, 0U);
  EXPECT_GT(unknown, 0U);
  const CellsCheck check = checkCells(*merged_);
  EXPECT_EQ(check.cells, told + unknown);
  EXPECT_LE(check.enough, told);
  EXPECT_GT(check.runs, kRuns);
}

TEST(CellsCheck, ComesTrueWithMoreRuns) {
  const auto check = [](std::uint64_t runs) {
    MergedRuns merged;
    RunResult run;
    run.rocks.resize(1);
    run.cells.resize(1);
    for (std::uint64_t i = 0; i < runs; ++i) {
      // Spread over a factor of two, in an order without a pattern.
      run.cells[0].maxEnergyJ = 1000 * std::exp2(static_cast<double>(i * 7919 % 1009) / 1009);
      merged.add(run, 1.0);
    }
    return checkCells(merged);
  };
  const CellsCheck few = check(20), many = check(5000);
  EXPECT_EQ(few.cells, 1U);
  EXPECT_EQ(few.enough, 0U);
  EXPECT_EQ(few.runs, 72U) << "one value a run";
  EXPECT_EQ(many.enough, 1U);
  EXPECT_LE(many.runs, 5000U);
  EXPECT_EQ(enoughText(few),
            "95 % of energy in cells: the runs are enough in 0 of 1 cells; for nine in ten, about 72 runs are\n");
  EXPECT_EQ(enoughText(CellsCheck{}), "");
}

}  // namespace
}  // namespace cairn::rockfall::cell_rasters_test
