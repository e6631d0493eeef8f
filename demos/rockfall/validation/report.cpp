// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/report.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace cairn::rockfall {
namespace {

using Ordered = nlohmann::ordered_json;

struct Quantity {
  const char *name, *key;
  Distribution Stops::*of;
};
constexpr std::array kQuantities{Quantity{"run-out", "runout", &Stops::runoutM},
                                 Quantity{"lateral", "lateral", &Stops::lateralM}};

struct Source {
  const char* name;
  const Stops& stops;
};
std::array<Source, 3> sourcesOf(const ProfileComparison& profile) {
  return {Source{"measured", profile.measured}, Source{"simulated", profile.simulated},
          Source{"published", profile.published}};
}

std::string percent(double ratio) {
  return fmt::format("{:+.0f} %", 100 * (ratio - 1));
}

std::string rowOf(const char* name, const Distribution& values, const Distribution& measured, bool isMeasured) {
  std::string row = fmt::format("  {:<10} {:>6}", name, values.size());
  for (const double share : kReportedShares) row += fmt::format(" {:>7.1f}", values.quantile(share));
  if (!isMeasured && !measured.empty()) {
    const Distance d = distanceOf(values, measured);
    row += fmt::format(" {:>6.2f} {:>6.2f} {:>8.1f} {:>8} {:>12}", d.kolmogorovSmirnov, d.kolmogorovSmirnovBound,
                       d.wassersteinM, percent(d.medianRatio), percent(d.middleHalfRatio));
  }
  return row + "\n";
}

std::string verdictOf(const char* name, const Distribution& simulated, const Distribution& measured) {
  const Distance d = distanceOf(simulated, measured);
  return fmt::format("{}: {} (median within {:.0f} %, middle half within {:.0f} % asked)\n", name,
                     d.fits() ? "fits" : "does not fit", 100 * kMedianWithin, 100 * kMiddleHalfWithin);
}

std::string textOf(const ProfileComparison& profile) {
  std::string text =
      fmt::format("{}, {}; metres from the middle of the places from which blocks fall\n", profile.name,
                  profile.isCalibrated ? "the slope that calibration uses" : "which calibration never sees");
  text += fmt::format("  {:<10} {:>6} {:>7} {:>7} {:>7} {:>7} {:>7} {:>6} {:>6} {:>8} {:>8} {:>12}\n", "", "blocks",
                      "5 %", "25 %", "50 %", "75 %", "95 %", "KS", "bound", "Wass. m", "median", "middle half");
  for (const Quantity& quantity : kQuantities) {
    const Distribution& measured = profile.measured.*quantity.of;
    text += fmt::format("{}\n", quantity.name);
    for (const Source& source : sourcesOf(profile))
      if (const Distribution& values = source.stops.*quantity.of; !values.empty())
        text += rowOf(source.name, values, measured, &source.stops == &profile.measured);
  }
  for (const Quantity& quantity : kQuantities)
    if (const Distribution& measured = profile.measured.*quantity.of; !measured.empty())
      text += verdictOf(quantity.name, profile.simulated.*quantity.of, measured);
  if (profile.measured.runoutM.empty()) text += "where blocks stopped is not in the folder: nothing to compare with\n";
  const Endings& e = profile.endings;
  text += fmt::format("ended: {} at rest, {} moving, {} off the ground, {} lost below it\n", e.resting, e.moving,
                      e.left, e.lost);
  text += fmt::format("greatest speed: median {:.1f}, 95 % {:.1f} m/s\n", e.maxSpeedMPerS.median(),
                      e.maxSpeedMPerS.quantile(0.95));
  text += "median run-out by scan, m:";
  for (const auto& scan : profile.scans) {
    text += fmt::format(" {} {:.1f}", scan.name, scan.simulated.runoutM.median());
    if (!scan.published.runoutM.empty()) text += fmt::format(" (published {:.1f})", scan.published.runoutM.median());
  }
  return text + "\n";
}

Ordered quantilesOf(const Distribution& values) {
  Ordered json{{"blocks", values.size()}};
  if (values.empty()) return json;
  for (const double share : kReportedShares) json[fmt::format("p{:02.0f}_m", 100 * share)] = values.quantile(share);
  return json;
}

Ordered jsonOf(const Distance& distance) {
  return {{"kolmogorov_smirnov", distance.kolmogorovSmirnov},
          {"kolmogorov_smirnov_bound_5_percent", distance.kolmogorovSmirnovBound},
          {"wasserstein_m", distance.wassersteinM},
          {"median_ratio", distance.medianRatio},
          {"middle_half_ratio", distance.middleHalfRatio},
          {"fits", distance.fits()}};
}

Ordered jsonOf(const ProfileComparison& profile) {
  Ordered json{{"profile", profile.name}, {"calibrated", profile.isCalibrated}};
  for (const Quantity& quantity : kQuantities) {
    Ordered about;
    const Distribution& measured = profile.measured.*quantity.of;
    for (const Source& source : sourcesOf(profile)) {
      const Distribution& values = source.stops.*quantity.of;
      about[source.name] = quantilesOf(values);
      if (&source.stops != &profile.measured && !values.empty() && !measured.empty())
        about[source.name]["against_measured"] = jsonOf(distanceOf(values, measured));
    }
    json[quantity.key] = about;
  }
  const Endings& e = profile.endings;
  json["endings"] = {{"resting", e.resting}, {"moving", e.moving}, {"left", e.left}, {"lost", e.lost}};
  json["max_speed_m_per_s"] = {{"p50", e.maxSpeedMPerS.median()}, {"p95", e.maxSpeedMPerS.quantile(0.95)}};
  for (const auto& scan : profile.scans)
    json["scans"][scan.name] = {{"simulated_runout", quantilesOf(scan.simulated.runoutM)},
                                {"published_runout", quantilesOf(scan.published.runoutM)}};
  return json;
}

}  // namespace

std::string validationText(std::span<const ProfileComparison> profiles) {
  std::string text;
  for (const ProfileComparison& profile : profiles) text += (text.empty() ? "" : "\n") + textOf(profile);
  return text;
}

std::string validationJson(std::span<const ProfileComparison> profiles, const ValidationSettings& settings) {
  Ordered json{{"validation", "authume"}, {"profiles", Ordered::array()}};
  for (const ProfileComparison& profile : profiles) json["profiles"].push_back(jsonOf(profile));
  json["settings"] = settings.document;
  return json.dump(1) + "\n";
}

std::string calibrationText(const Calibration& calibration, const ValidationSettings& settings) {
  const Trial& first = calibration.trials.front();
  const Trial& best = calibration.trials[calibration.best];
  const CalibrationPlan& plan = settings.calibration;
  std::string text = fmt::format("calibrated on P1: seed {}, {} rounds of {} candidates, {} blocks each\n", plan.seed,
                                 plan.rounds, plan.candidates, calibration.blocks);
  for (std::uint32_t round = 0; round <= plan.rounds; ++round) {
    double least = first.misfit;
    for (const Trial& trial : calibration.trials)
      if (trial.round <= round) least = std::min(least, trial.misfit);
    text += fmt::format("  misfit after round {}: {:.3f}\n", round, least);
  }
  text += fmt::format("  {:<22} {:>8} {:>8} {:>8} {:>8}\n", "parameter", "from", "to", "before", "found");
  for (std::size_t i = 0; i < plan.parameters.size(); ++i) {
    const CalibratedParameter& parameter = plan.parameters[i];
    text += fmt::format("  {:<22} {:>8g} {:>8g} {:>8g} {:>8g}\n", parameter.name, parameter.range[0],
                        parameter.range[1], first.values[i], best.values[i]);
  }
  return text;
}

Result<std::string> calibratedSettings(const Calibration& calibration, const ValidationSettings& settings) {
  const Trial& best = calibration.trials[calibration.best];
  auto found = withValues(settings, best.values);
  if (!found) return found.error();
  const CalibrationPlan& plan = settings.calibration;
  Json document = std::move(found.value().document);
  document["origin"] = fmt::format(
      "rockfall validate --calibrate on P1: seed {}, {} rounds of {} candidates, {} blocks each; misfit {:.3f}",
      plan.seed, plan.rounds, plan.candidates, calibration.blocks, best.misfit);
  return document.dump(2) + "\n";
}

}  // namespace cairn::rockfall
