// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/convergence/convergence_report.h"

#include <fmt/format.h>

#include "rockfall/case/document.h"

namespace cairn::rockfall {
namespace {

using Ordered = nlohmann::ordered_json;

constexpr std::array<const char*, kConvergedNames.size()> kKeys{"runout", "max_speed", "max_energy"},
    kUnits{"m", "m_per_s", "j"};
constexpr std::array<double, kConvergedNames.size()> kPrintedUnits{1, 1, 1000};
constexpr std::array<const char*, kConvergedNames.size()> kPrintedNames{"run-out m", "greatest m/s", "greatest kJ"};

const char* nameOf(StepVerdict verdict) {
  switch (verdict) {
    case StepVerdict::fine:
      return "fine enough";
    case StepVerdict::coarse:
      return "too coarse";
    case StepVerdict::undecided:
      return "not told";
    case StepVerdict::reference:
      break;
  }
  return "reference";
}

std::string cell(const StepDifference& difference) {
  return fmt::format("{:+.1f} ({:+.1f} to {:+.1f})", 100 * difference.mean, 100 * difference.low,
                     100 * difference.high);
}

std::string rowOf(const ConvergenceStep& step) {
  std::string row = fmt::format("{:>9.4g}", 1000 * step.stepS);
  for (std::size_t q = 0; q < kConvergedNames.size(); ++q) {
    const std::string difference = step.verdict == StepVerdict::reference ? "" : cell(step.differences[q]);
    row += fmt::format("  {:>12.4g} {:>23}", step.means[q] / kPrintedUnits[q], difference);
  }
  row += fmt::format("  {}", nameOf(step.verdict));
  if (step.runsWanted > 0) row += fmt::format(": about {} runs would tell", step.runsWanted);
  return row + "\n";
}

std::string answerOf(const Convergence& found, double tolerance) {
  const double finest = found.steps.back().stepS;
  if (found.fineStepS)
    return fmt::format(
        "a step of {:.4g} ms is fine enough: the means of {} are within {:g} % of those at {:.4g} ms, 95 times in a "
        "hundred\n",
        1000 * *found.fineStepS, found.judgesRunouts() ? "all three" : "speed and energy", 100 * tolerance,
        1000 * finest);
  const ConvergenceStep& next = found.steps[found.steps.size() - 2];
  if (next.verdict == StepVerdict::coarse)
    return fmt::format("no step is fine enough: {:.4g} ms still differs from {:.4g} ms; give more --halvings\n",
                       1000 * next.stepS, 1000 * finest);
  return fmt::format("these runs do not tell which step is fine enough: give more --runs or a wider --tolerance\n");
}

}  // namespace

std::string convergenceText(const Convergence& found, const Case& description, double tolerance) {
  std::string text = fmt::format(
      "{}: the same {} rocks in {} runs at each step; in % what they have more than at the finest, and where the mean "
      "is 95 times in a hundred\n",
      description.name, found.rocks, found.runs);
  text += fmt::format("{:>9}", "step ms");
  for (const char* name : kPrintedNames) text += fmt::format("  {:>12} {:>23}", name, "%");
  text += "\n";
  for (const ConvergenceStep& step : found.steps) text += rowOf(step);
  if (!found.judgesRunouts())
    text += fmt::format(
        "{} of {} rocks left the map or still moved at the end: their run-outs decide nothing; give more "
        "ground or time\n",
        found.cutOff, found.rocks);
  return text + answerOf(found, tolerance);
}

std::string convergenceJson(const Convergence& found, const Case& description, double tolerance) {
  Ordered json{{"case", description.name}, {"runs", found.runs},     {"rocks", found.rocks},
               {"cut_off", found.cutOff},  {"tolerance", tolerance}, {"steps", Ordered::array()}};
  for (const ConvergenceStep& step : found.steps) {
    Ordered one{{"step_s", step.stepS}, {"verdict", nameOf(step.verdict)}};
    for (std::size_t q = 0; q < kConvergedNames.size(); ++q) {
      one[fmt::format("mean_{}_{}", kKeys[q], kUnits[q])] = step.means[q];
      if (step.verdict == StepVerdict::reference) continue;
      const StepDifference& d = step.differences[q];
      one[fmt::format("{}_difference_fraction", kKeys[q])] = {{"mean", d.mean}, {"low_95", d.low}, {"high_95", d.high}};
    }
    if (step.runsWanted > 0) one["runs_wanted"] = step.runsWanted;
    json["steps"].push_back(one);
  }
  json["fine_step_s"] = found.fineStepS ? Ordered(*found.fineStepS) : Ordered(nullptr);
  return json.dump(1) + "\n";
}

}  // namespace cairn::rockfall
