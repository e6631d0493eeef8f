// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/fit_columns.h"

#include <array>
#include <utility>

#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {
namespace {

using builder::LevelFit;

struct Column {
  const char* name;
  double LevelFit::*value;
};

constexpr std::array kColumns{
    Column{"certified_max_fraction", &LevelFit::certifiedMaxFraction},
    Column{"certified_rms_fraction", &LevelFit::certifiedRmsFraction},
    Column{"sampled_max_fraction", &LevelFit::sampledMaxFraction},
    Column{"sampled_mean_fraction", &LevelFit::sampledMeanFraction},
    Column{"sampled_rms_fraction", &LevelFit::sampledRmsFraction},
    Column{"sampled_variance_fraction_squared", &LevelFit::sampledVarianceFractionSquared},
    Column{"uncovered_area_fraction", &LevelFit::uncoveredAreaFraction},
    Column{"uncovered_volume_fraction", &LevelFit::uncoveredVolumeFraction},
    Column{"wasted_volume_fraction", &LevelFit::wastedVolumeFraction},
    Column{"wasted_volume_standard_error_fraction", &LevelFit::wastedVolumeStandardErrorFraction},
};

}  // namespace

std::vector<std::string> withFitColumns(std::vector<std::string> columns) {
  for (const Column& column : kColumns) columns.emplace_back(column.name);
  return columns;
}

std::vector<std::string> withFit(std::vector<std::string> cells, const LevelFit& fit) {
  for (const Column& column : kColumns) cells.push_back(cellOf(fit.*column.value));
  return cells;
}

}  // namespace cairn::accuracy_cost
