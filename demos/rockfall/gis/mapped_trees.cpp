// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/gis/mapped_trees.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>

#include "cairn/core/mix_bits.h"
#include "rockfall/case/draw_stem.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {
namespace {

constexpr std::uint64_t kTreeFamily = 0x7472656573;  // separate from the seeds of runs and of terrains
constexpr double kHectareM2 = 1e4;
constexpr double kMaxStems = 2e6;
constexpr double kThickest = 5;  // m; as of stems in a case

/// Draws the stems of one map.
class Planter {
 public:
  Planter(const Case& description, std::uint64_t effect)
      : random_(mixBits(mixBits(description.seed + kTreeFamily) + effect)) {}

  /// False if there would be too many.
  bool plant(const PlaceSet& places, double sizeM2, const StandOfTrees& stand) {
    const double count = stand.densityPerHa * sizeM2 / kHectareM2;
    if (static_cast<double>(stems_.size()) + count > kMaxStems) return false;
    for (auto left = std::llround(count); left > 0; --left) {
      const double which = random_.uniform(), along = random_.uniform(), across = random_.uniform();
      stems_.push_back(drawStem(stand, places.at(which, along, across), random_));
    }
    return true;
  }
  std::vector<Stem> take() { return std::move(stems_); }

 private:
  scenes::Random random_;
  std::vector<Stem> stems_;
};

Error tooMany(const MapSource& source) {
  return MapReader::refused(source, fmt::format("would have more than {:.0f} million stems: use smaller densities, or "
                                                "cut out what the terrain covers",
                                                kMaxStems / 1e6));
}

Result<double> diameterOf(const std::optional<std::string>& text) {
  double diameter = 0;
  if (!text) return Error{"its diameter is missing"};
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), diameter);
  if (error != std::errc{} || end != text->data() + text->size() || !(diameter > 0))
    return Error{fmt::format("its diameter is \"{}\": it must be a positive number of metres", *text)};
  if (diameter > kThickest)
    return Error{
        fmt::format("no stem is {:g} m thick: the field must hold the diameter at breast height in metres, not "
                    "the height, nor centimetres",
                    diameter)};
  return diameter;
}

Result<std::vector<Stem>> stemsOf(const MapReader& reader, const MappedTrees& trees, std::vector<MapNote>& notes) {
  const auto layer = reader.layer(trees.map, {Shape::point}, trees.diameterField);
  if (!layer) return layer.error();
  std::vector<Stem> stems;
  for (const MapFeature& feature : layer.value().features) {
    const auto diameter = diameterOf(feature.text);
    if (!diameter)
      return MapReader::refused(trees.map, fmt::format("feature {}: {}", feature.id, diameter.error().message));
    for (const MapPoint& point : feature.points) stems.push_back({point, diameter.value()});
  }
  notes.push_back(reader.note(trees.map, layer.value()));
  return stems;
}

double sizeOf(const Area& area) {
  const auto size = [](const Polygon& ring) {
    double twice = 0;
    for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++)
      twice += (ring[last][0] - ring[0][0]) * (ring[i][1] - ring[0][1]) -
               (ring[i][0] - ring[0][0]) * (ring[last][1] - ring[0][1]);
    return std::abs(twice) / 2;
  };
  double sum = size(area.outline);
  for (const Polygon& hole : area.holes) sum -= size(hole);
  return sum;
}

Result<std::vector<Stem>> standsOf(const MapReader& reader, const MappedTrees& trees, Planter planter,
                                   std::vector<MapNote>& notes) {
  const auto layer = reader.layer(trees.map, {Shape::area}, trees.stands.field);
  if (!layer) return layer.error();
  for (const MapFeature& feature : layer.value().features) {
    if (!reader.bounds().mayMeet(feature)) continue;
    const auto stand = meaningOf(trees.stands, feature.text.value_or(""));
    if (!stand) return MapReader::refused(trees.map, fmt::format("feature {}: {}", feature.id, stand.error().message));
    if (!stand.value()) continue;
    for (const Area& area : feature.areas) {
      PlaceSet places;
      if (!places.addArea(area))
        return MapReader::refused(trees.map, fmt::format("feature {}: it is too ragged: simplify it", feature.id));
      if (!places.empty() && !planter.plant(places, sizeOf(area), *stand.value())) return tooMany(trees.map);
    }
  }
  notes.push_back(reader.note(trees.map, layer.value()));
  return planter.take();
}

Result<std::vector<Stem>> cellStandsOf(const MapReader& reader, const MappedTrees& trees, Planter planter,
                                       std::vector<MapNote>& notes) {
  const auto read = reader.raster(trees.map);
  if (!read) return read.error();
  const Raster& raster = read.value();
  const double half = raster.cell / 2;
  std::map<double, PlaceSet> classes;
  for (std::uint32_t row = 0; row < raster.rows; ++row)
    for (std::uint32_t column = 0; column < raster.columns; ++column) {
      const double value = raster.at(column, row), x = raster.x + column * raster.cell,
                   y = raster.y + row * raster.cell;
      if (std::isnan(value)) continue;
      classes[value].add(
          {MapPoint{x - half, y - half}, {x + half, y - half}, {x - half, y + half}, {x + half, y + half}}, 1);
    }
  for (const auto& [value, places] : classes) {
    const auto stand = meaningOf(trees.stands, classOfCell(value));
    if (!stand) return MapReader::refused(trees.map, "in a cell: " + stand.error().message);
    const double size = raster.cell * raster.cell * static_cast<double>(places.pieces().size());
    if (stand.value() && !planter.plant(places, size, *stand.value())) return tooMany(trees.map);
  }
  notes.push_back(reader.note(trees.map, raster));
  return planter.take();
}

}  // namespace

Status readTrees(const MapReader& reader, Case& description) {
  std::uint64_t number = 0;  // among effects of this kind, so that the order of the list has no influence
  for (EffectOptions& effect : description.effects) {
    auto* const options = std::get_if<TreesOptions>(&effect);
    if (!options) continue;
    const Planter planter(description, number++);
    const auto* const trees = std::get_if<MappedTrees>(&options->stems);
    if (!trees) continue;
    auto stems = trees->map.isRaster            ? cellStandsOf(reader, *trees, planter, description.notes)
                 : trees->diameterField.empty() ? standsOf(reader, *trees, planter, description.notes)
                                                : stemsOf(reader, *trees, description.notes);
    if (!stems) return stems.error();
    description.notes.back().text += fmt::format(", {} stems", stems.value().size());
    options->stems = std::move(stems).value();
  }
  return {};
}

}  // namespace cairn::rockfall
