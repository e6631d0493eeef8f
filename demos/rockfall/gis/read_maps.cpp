// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/gis/read_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rockfall/gis/map_reader.h"
#include "rockfall/gis/mapped_releases.h"
#include "rockfall/gis/mapped_trees.h"
#include "rockfall/gis/mapped_zones.h"

namespace cairn::rockfall {
namespace {

Status readLinesOf(const MapReader& reader, std::optional<MapSource>& map, std::vector<Polyline>& lines,
                   std::vector<MapNote>& notes) {
  if (!map) return {};
  const auto layer = reader.layer(*map, {Shape::line}, {});
  if (!layer) return layer.error();
  for (const MapFeature& feature : layer.value().features)
    lines.insert(lines.end(), feature.lines.begin(), feature.lines.end());
  notes.push_back(reader.note(*map, layer.value()));
  map.reset();
  return {};
}

Status readAllLines(const MapReader& reader, Case& description) {
  for (Dam& dam : description.terrain.dams)
    if (const Status read = readLinesOf(reader, dam.map, dam.lines, description.notes); !read) return read;
  for (Collector& collector : description.collectors)
    if (const Status read = readLinesOf(reader, collector.map, collector.lines, description.notes); !read) return read;
  for (EffectOptions& effect : description.effects)
    if (auto* barrier = std::get_if<BarrierOptions>(&effect))
      if (const Status read = readLinesOf(reader, barrier->map, barrier->lines, description.notes); !read) return read;
  return {};
}

}  // namespace

Status readMaps(Case& description, const MapTerrain& terrain) {
  if (mapsOf(description).empty()) return {};
  const MapReader reader(description, terrain);
  if (const Status read = readZones(reader, description); !read) return read;
  if (const Status read = readReleases(reader, description); !read) return read;
  if (const Status read = readAllLines(reader, description); !read) return read;
  return readTrees(reader, description);
}

}  // namespace cairn::rockfall
