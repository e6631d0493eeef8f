// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/comparison.h"

#include <cmath>
#include <utility>

namespace cairn::rockfall {
namespace {

Vec3d middleOf(const std::vector<Vec3d>& places) {
  Vec3d sum;
  for (const Vec3d& place : places) sum = sum + place;
  return sum * (1 / static_cast<double>(places.size()));
}

Stops stopsAt(const QuarryProfile& profile, const std::vector<Vec3d>& places) {
  const Vec3d from = middleOf(profile.drops);
  std::vector<double> along, across;
  for (const Vec3d& place : places) {
    along.push_back(place.x - from.x);
    across.push_back(from.y - place.y);  // the data's z runs against the map's y
  }
  return {Distribution(std::move(along)), Distribution(std::move(across))};
}

Stops publishedStops(const QuarryProfile& profile, const std::string& scan) {
  std::vector<Vec3d> places;
  for (const PublishedRun& run : profile.published)
    if (scan.empty() || run.shape == scan) places.push_back(run.stop);
  return stopsAt(profile, places);
}

Endings endingsOf(std::span<const BlockEnd> ends) {
  Endings endings;
  std::vector<double> speeds;
  for (const BlockEnd& end : ends) {
    endings.resting += end.ending == RockEnd::resting;
    endings.moving += end.ending == RockEnd::moving;
    endings.left += end.ending == RockEnd::left || end.ending == RockEnd::hole;
    endings.lost += end.ending == RockEnd::lost;
    speeds.push_back(end.maxSpeedMPerS);
  }
  endings.maxSpeedMPerS = Distribution(std::move(speeds));
  return endings;
}

double ratio(double a, double b) {
  return b == 0 ? 0 : a / b;
}

}  // namespace

bool Distance::fits() const {
  return std::abs(medianRatio - 1) <= kMedianWithin && std::abs(middleHalfRatio - 1) <= kMiddleHalfWithin;
}

Distance distanceOf(const Distribution& simulated, const Distribution& measured) {
  return {kolmogorovSmirnov(simulated, measured), kolmogorovSmirnovBound(simulated.size(), measured.size()),
          wasserstein(simulated, measured), ratio(simulated.median(), measured.median()),
          ratio(simulated.middleHalf(), measured.middleHalf())};
}

Stops stopsOf(const QuarryProfile& profile, std::span<const BlockEnd> ends) {
  std::vector<Vec3d> places;
  for (const BlockEnd& end : ends) places.push_back(end.stop);
  return stopsAt(profile, places);
}

Stops measuredStops(const QuarryProfile& profile) {
  std::vector<Vec3d> places;
  for (const MeasuredBlock& block : profile.blocks) places.push_back(block.stop);
  return stopsAt(profile, places);
}

ProfileComparison compareProfile(const QuarryScene& quarry, std::span<const BlockRun> runs,
                                 std::span<const BlockEnd> ends) {
  const std::size_t index = runs.front().profile;
  const QuarryProfile& profile = quarry.data.profiles[index];
  ProfileComparison comparison;
  comparison.name = profile.name;
  comparison.isCalibrated = index == 0;
  comparison.measured = measuredStops(profile);
  comparison.simulated = stopsOf(profile, ends);
  comparison.published = publishedStops(profile, {});
  comparison.endings = endingsOf(ends);
  for (std::size_t scan = 0; scan < kScanNames.size(); ++scan) {
    std::vector<BlockEnd> own;
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (quarry.blocks[runs[i].block].scan == scan) own.push_back(ends[i]);
    if (!own.empty())
      comparison.scans.push_back({kScanNames[scan], stopsOf(profile, own), publishedStops(profile, kScanNames[scan])});
  }
  return comparison;
}

}  // namespace cairn::rockfall
