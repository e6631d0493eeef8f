// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/blocks.h"

#include <algorithm>
#include <cmath>

namespace cairn::rockfall {
namespace {

const RockShape& shapeOf(const RockStock& stock, std::size_t scan) {
  return stock.groups[scan].front();
}

double massOf(const RockShape& shape, double sieveM, double densityKgPerM3) {
  return densityKgPerM3 * shape.volume * sieveM * sieveM * sieveM;
}

/// How unlike the proportions of two boxes are: the distance of the logarithms of their two ratios.
double unlikeness(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(std::log(a[1] / a[2] * b[2] / b[1]), std::log(a[0] / a[2] * b[2] / b[0]));
}

Block nearestTo(const MeasuredBlock& measured, const RockStock& stock, double densityKgPerM3) {
  const std::array<double, 3> box{measured.boxM[2], measured.boxM[1], measured.boxM[0]};
  Block block;
  for (std::size_t scan = 1; scan < kScanNames.size(); ++scan)
    if (unlikeness(shapeOf(stock, scan).extents, box) < unlikeness(shapeOf(stock, block.scan).extents, box))
      block.scan = scan;
  block.massKg = measured.massKg;
  block.sieveM = std::cbrt(measured.massKg / massOf(shapeOf(stock, block.scan), 1, densityKgPerM3));
  return block;
}

}  // namespace

Result<std::vector<Block>> chooseBlocks(const QuarryData& data, const RockStock& stock,
                                        const ValidationSettings& settings) {
  std::vector<Block> blocks;
  if (settings.blocks == BlockChoice::scans) {
    for (std::size_t scan = 0; scan < kScanNames.size(); ++scan) {
      const double sieveM = 1 / shapeOf(stock, scan).scale;
      blocks.push_back({scan, sieveM, massOf(shapeOf(stock, scan), sieveM, settings.densityKgPerM3)});
    }
    return blocks;
  }
  for (const MeasuredBlock& measured : data.profiles.front().blocks)
    blocks.push_back(nearestTo(measured, stock, settings.densityKgPerM3));
  if (blocks.empty())
    return Error{data.folder.string() +
                 " does not say how large the blocks were: add Endpoints_P1.txt, or set \"blocks\" to \"scans\""};
  return blocks;
}

}  // namespace cairn::rockfall
