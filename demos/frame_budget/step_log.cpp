// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_log.h"

#include <fmt/format.h>

#include <iterator>

namespace cairn::frame_budget {

std::string stepLog(const std::vector<LoggedRun>& runs) {
  std::string text =
      "shape,step,narrow_phase_cpu_us,step_cpu_us,contacts,manifolds,operations,pairs,unresolved_pairs,"
      "mean_error_fraction,worst_error_fraction,mean_seen_error_rad,worst_seen_error_rad,elapsed_us,missed_by_us\n";
  for (const LoggedRun& run : runs)
    for (std::size_t step = 0; step < run.records.size(); ++step) {
      const scenes::StepRecord& r = run.records[step];
      fmt::format_to(std::back_inserter(text), "{},{},{:.2f},{:.2f},{},{}", scenes::shapeName(run.shape), step + 1,
                     r.narrowPhaseCpuUs, r.stepCpuUs, r.contacts, r.manifolds);
      if (r.tree)
        fmt::format_to(std::back_inserter(text), ",{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.2f},{:.2f}\n",
                       r.tree->operations, r.tree->pairs, r.tree->unresolvedPairs, r.tree->meanErrorFraction,
                       r.tree->worstErrorFraction, r.tree->meanSeenError, r.tree->worstSeenError,
                       r.tree->elapsedMicroseconds, r.tree->missedByMicroseconds);
      else
        text += ",,,,,,,,,\n";
    }
  return text;
}

}  // namespace cairn::frame_budget
