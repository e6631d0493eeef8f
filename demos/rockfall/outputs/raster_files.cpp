// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/raster_files.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>
#include <memory>

#include "cairn/core/atomic_file.h"
#include "rockfall/terrain/ascii_grid.h"
#include "rockfall/terrain/geo_raster.h"
#include "rockfall/terrain/projection.h"

namespace cairn::rockfall {
namespace {

struct QuantityNames {
  Quantity quantity;
  const char *name, *title, *unit, *suffix;
  bool hasBounds;  ///< those that barriers are designed for
};
constexpr std::array<QuantityNames, kQuantities> kNames{
    QuantityNames{Quantity::energy, "energy", "kinetic energies", "J", "j", true},
    QuantityNames{Quantity::translation, "translation", "kinetic energies of translation", "J", "j", false},
    QuantityNames{Quantity::rotation, "rotation", "kinetic energies of rotation", "J", "j", false},
    QuantityNames{Quantity::speed, "speed", "speeds", "m/s", "m_per_s", false},
    QuantityNames{Quantity::height, "height", "heights of centres above the ground", "m", "m", true}};

constexpr std::array kQuantiles{500U, 950U, 990U};
constexpr std::uint32_t kDesign = 950;  // thousandths

/// Confidence ranks by the number of values, which many cells share.
class RankTable {
 public:
  Ranks of(std::uint64_t count) {
    const auto [place, isNew] = ranks_.try_emplace(count);
    if (isNew) place->second = confidenceRanks(count, kDesign);
    return place->second;
  }

 private:
  std::map<std::uint64_t, Ranks> ranks_;
};

void addFigures(const QuantityNames& names, std::vector<RasterKind>& kinds) {
  const auto add = [&](const std::string& figure, const std::string& title, auto value) {
    kinds.push_back({fmt::format("{}_{}_{}", names.name, figure, names.suffix),
                     fmt::format("{} of the rocks' greatest {}", title, names.title), names.unit,
                     [quantity = names.quantity, value](const CellSummary& c) { return value(c.of(quantity)); }});
  };
  add("mean", "mean", [](const LogHistogram& values) { return values.mean(); });
  for (const std::uint32_t share : kQuantiles)
    add(fmt::format("p{}", share / 10), fmt::format("{} % quantile", share / 10),
        [share](const LogHistogram& values) { return values.quantile(share); });
  add("max", "greatest", [](const LogHistogram& values) { return values.greatest(); });
}

void addBounds(const QuantityNames& names, std::vector<RasterKind>& kinds) {
  const auto table = std::make_shared<RankTable>();
  const auto boundsOf = [quantity = names.quantity, table](const CellSummary& c) {
    const LogHistogram& values = c.of(quantity);
    return values.count() > 0 ? values.bounds(table->of(values.count())) : Interval{};
  };
  const auto add = [&](const char* which, std::function<double(const CellSummary&)> value) {
    kinds.push_back({fmt::format("{}_p95_{}_{}", names.name, which, names.suffix),
                     fmt::format("{}er 95 % confidence bound of the 95 % quantile of {}", which, names.title),
                     names.unit, std::move(value)});
  };
  add("low", [boundsOf](const CellSummary& c) { return boundsOf(c).low; });
  // Without a value where there are too few rocks to tell.
  add("high",
      [boundsOf](const CellSummary& c) { return boundsOf(c).high.value_or(std::numeric_limits<double>::quiet_NaN()); });
}

}  // namespace

std::vector<RasterKind> rasterKinds(const Case& description, const MergedRuns& merged) {
  if (!description.outputs.rasterCellM) return {};
  std::vector<RasterKind> kinds{{"reach", "rocks that passed, of all runs", "",
                                 [](const CellSummary& c) { return static_cast<double>(c.passages()); }},
                                {"reach_probability", "share of all released rocks that came here", "",
                                 [&merged](const CellSummary& c) {
                                   return static_cast<double>(c.arrived) / static_cast<double>(merged.released);
                                 }},
                                {"stops", "rocks that ended here, of all runs", "",
                                 [](const CellSummary& c) { return static_cast<double>(c.stops); }}};
  for (const QuantityNames& names : kNames) {
    addFigures(names, kinds);
    if (names.hasBounds) addBounds(names, kinds);
  }
  return kinds;
}

std::string asciiRaster(const RasterKind& kind, const Case& description, const Ground& ground,
                        const MergedRuns& merged) {
  return asciiGrid(rasterOf(rasterFrame(ground, *description.outputs.rasterCellM), merged, kind.value));
}

Status writeGeoRasters(const std::filesystem::path& folder, const Case& description, const Ground& ground,
                       const MergedRuns& merged) {
  const std::string prj = prjOf(ground.projection());
  for (const RasterKind& kind : rasterKinds(description, merged)) {
    if (!prj.empty())
      if (const Status written = writeFileAtomically(folder / (kind.name + ".prj"), std::string_view(prj)); !written)
        return written;
    if (!description.outputs.geotiff) continue;
    Raster raster = rasterOf(rasterFrame(ground, *description.outputs.rasterCellM), merged, kind.value);
    raster.projection = ground.projection();
    if (const Status written = writeGeoTiff(folder / (kind.name + ".tif"), raster, {kind.description, kind.unit});
        !written)
      return written;
  }
  return {};
}

}  // namespace cairn::rockfall
