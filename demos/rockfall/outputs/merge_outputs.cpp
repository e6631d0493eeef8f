// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/merge_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <system_error>
#include <utility>

#include "cairn/core/atomic_file.h"
#include "rockfall/case/content_hash.h"
#include "rockfall/gis/read_maps.h"
#include "rockfall/outputs/figures.h"
#include "rockfall/outputs/geo_tables.h"
#include "rockfall/outputs/raster_files.h"
#include "rockfall/outputs/svg.h"
#include "rockfall/outputs/tables.h"
#include "rockfall/terrain/dams.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall {
namespace {

namespace fs = std::filesystem;
using Ordered = nlohmann::ordered_json;

/// Collects all outputs from the runs, one run after the other.
struct Gathered {
  Gathered(const Case& description, const MergeOptions& options, std::vector<RunRange> missingRuns)
      : missing(std::move(missingRuns)),
        wantsPlaces(options.geopackage || options.geojson),
        tables(description),
        collectors(description) {
    merged.collectors.resize(description.collectors.size());
  }

  void add(const RunFile& file, const std::optional<double>& cellM) {
    const RunResult& result = file.result;
    merged.add(result, cellM);
    tables.add(result);
    if (wantsPlaces) places.add(result);
    collectors.add(result);
    for (const RockRecord& rock : result.rocks) runouts.add(rock);
    for (std::uint32_t rock = 0; rock < result.trajectories.size(); ++rock)
      trajectories.push_back({result.run, rock, result.trajectories[rock]});
    for (const RockRecord& rock : result.rocks)
      if (rock.ending == RockEnd::resting || rock.ending == RockEnd::moving)
        stops.push_back({{rock.end.x, rock.end.y}, rock.ending});
    addCost(file.cost);
  }

  void addCost(const RunCost& cost) {
    cpuS += cost.cpuS;
    if (effects.size() < cost.effects.size()) effects.resize(cost.effects.size());
    for (std::size_t i = 0; i < cost.effects.size(); ++i) {
      effects[i].name = cost.effects[i].name;
      effects[i].acted += cost.effects[i].acted;
      effects[i].elapsedUs += cost.effects[i].elapsedUs;
    }
  }

  std::vector<RunRange> missing;
  bool wantsPlaces;
  MergedRuns merged;
  Tables tables;
  GeoTables places;
  CollectorStatistics collectors;
  Runouts runouts;
  std::vector<Trajectory> trajectories;
  std::vector<StopPoint> stops;
  double cpuS = 0;
  std::vector<EffectReport> effects;
};

Ordered quantilesJson(const LogHistogram& histogram) {
  return {{"median", histogram.quantile(500)}, {"p95", histogram.quantile(950)}, {"max", histogram.greatest()}};
}

Ordered effectsJson(const MergedRuns& merged) {
  Ordered effects = Ordered::array();
  for (std::size_t i = 0; i < merged.effects.size(); ++i) {
    const EffectRecord& effect = merged.effects[i];
    effects.push_back({{"effect", effect.name},
                       {"path", fmt::format("/effects/{}", i)},
                       {"acts", effect.acts},
                       {"energy_taken_j", effect.energyTakenJ},
                       {"impulse_n_s", effect.impulseNS},
                       {"torque_impulse_n_m_s", effect.torqueImpulseNMS}});
  }
  return effects;
}

Json rangesJson(const std::vector<RunRange>& ranges) {
  Json list = Json::array();
  for (const RunRange& range : ranges) list.push_back({range.first, range.last});
  return list;
}

std::string summaryText(const Case& description, const MergedRuns& merged, const std::vector<RunRange>& missing) {
  Ordered endings, collectors = Ordered::array();
  for (std::size_t i = 0; i < merged.endings.size(); ++i) endings[nameOf(static_cast<RockEnd>(i))] = merged.endings[i];
  for (std::size_t i = 0; i < merged.collectors.size(); ++i) {
    const CollectorSummary& collector = merged.collectors[i];
    collectors.push_back({{"name", description.collectors[i].name},
                          {"crossings", collector.crossings},
                          {"rocks", collector.rocks},
                          {"energy_j", quantilesJson(collector.energyJ)},
                          {"height_m", quantilesJson(collector.heightM)},
                          {"speed_m_per_s", quantilesJson(collector.speed)}});
  }
  const Ordered json{
      {"case", description.name},
      {"runs", merged.runs},
      {"missing_runs", countOf(missing)},
      {"missing_run_ranges", rangesJson(missing)},
      {"rocks", merged.rocks},
      {"endings", endings},
      {"impacts", merged.impacts},
      {"mean_runout_m", merged.runoutM.count() ? merged.runoutSumM / static_cast<double>(merged.runoutM.count()) : 0},
      {"runouts_cut_off", merged.runoutsCutOff},
      {"runout_m", quantilesJson(merged.runoutM)},
      {"max_energy_j", quantilesJson(merged.energyJ)},
      {"max_height_m", quantilesJson(merged.heightM)},
      {"collectors", collectors},
      {"released_energy_j", merged.releasedEnergyJ},
      {"energy_rise_j", merged.energyRiseJ},
      {"effects", effectsJson(merged)}};
  return json.dump(1) + "\n";
}

/// A file's name and its content, which is made when it is written: only one is in memory.
using File = std::pair<std::string, std::function<std::string()>>;

/// What programs for maps read, on request. Its bytes depend on GDAL's version, so the merged hash leaves it out.
Status writeGeoTables(const MergeOptions& options, const std::string& projection, std::vector<GeoTable> tables) {
  // No table without rows: it would stand for a thing that nobody recorded.
  std::erase_if(tables, [](const GeoTable& table) { return table.rows.empty(); });
  if (options.geopackage)
    if (const Status written = writeGeoPackage(options.folder / "results.gpkg", tables, projection); !written)
      return written;
  if (!options.geojson) return {};
  for (const GeoTable& table : tables)
    if (const Status written = writeGeoJson(options.folder / (table.name + ".geojson"), table, projection); !written)
      return written;
  return {};
}

/// The arguments must outlive the files.
std::vector<File> filesOf(const Case& description, const Ground& ground, const Gathered& gathered,
                          const std::vector<CollectorFigures>& figures) {
  const OutputsSection& outputs = description.outputs;
  const MergedRuns& merged = gathered.merged;
  std::vector<File> files{{"runs.csv", [&] { return gathered.tables.runs(); }},
                          {"rocks.csv", [&] { return gathered.tables.rocks(); }},
                          {"effects.csv", [&] { return gathered.tables.effects(); }},
                          {"summary.json", [&] { return summaryText(description, merged, gathered.missing); }}};
  if (outputs.impactsAboveJ) files.emplace_back("impacts.csv", [&] { return gathered.tables.impacts(); });
  if (!description.collectors.empty()) {
    files.emplace_back("collectors.csv", [&] { return gathered.tables.crossings(); });
    files.emplace_back("collectors_summary.csv", [&] { return collectorsSummary(figures); });
  }
  for (RasterKind& kind : rasterKinds(description, merged)) {
    const std::string name = kind.name + ".asc";
    files.emplace_back(name, [&, kind = std::move(kind)] { return asciiRaster(kind, description, ground, merged); });
  }
  if (outputs.trajectoriesEveryS)
    files.emplace_back("trajectories.vtk", [&] { return vtkPolydata(gathered.trajectories); });
  files.emplace_back("map.svg", [&] { return mapFigure(description, ground, gathered.trajectories, gathered.stops); });
  if (outputs.rasterCellM && !merged.distances.empty())
    files.emplace_back("profiles.svg", [&] { return profileFigure(description, merged, *outputs.rasterCellM); });
  std::ranges::sort(files, {}, &File::first);
  return files;
}

std::string hashOfContent(std::string_view content) {
  ContentHash hash;
  hash.add(content);
  return hash.hex();
}

/// Writes the files, then the manifest with their names. Returns the hash over all.
Result<std::string> write(const std::vector<File>& files, const Parts& parts, const fs::path& folder) {
  Ordered hashes;
  ContentHash all;
  for (const auto& [name, make] : files) {
    const std::string content = make();
    if (const Status written = writeFileAtomically(folder / name, std::string_view(content)); !written)
      return written.error();
    hashes[name] = hashOfContent(content);
    all.add(name);
    all.add(content);
  }
  const std::string hash = all.hex();
  const Manifest& manifest = parts.manifest();
  const Ordered json{
      {"merged_hash", hash},           {"case_hash", manifest.caseHash},          {"scene_hash", manifest.sceneHash},
      {"versions", manifest.versions}, {"merged_runs", rangesJson(parts.runs())}, {"files", hashes},
      {"case", manifest.document}};
  if (const Status written = writeFileAtomically(folder / kManifestName, json.dump(1) + "\n"); !written)
    return written.error();
  return hash;
}

/// The case of the runs.
Result<Case> caseOf(const Manifest& manifest) {
  auto description = parseCase(manifest.document.dump(), "the case in the manifest", manifest.caseFolder);
  if (description && description.value().hash != manifest.caseHash)
    return Error{"the files the case names have changed since it was run"};
  return description;
}

Status prepare(const MergeOptions& options) {
  if (options.png)
    if (const Status there = checkRenderer(); !there) return there;
  if ((options.geopackage || options.geojson) && !hasGdal())
    return Error{
        "this program was built without GDAL, which --geopackage and --geojson need: install libgdal-dev and build "
        "again, or do without"};
  for (const fs::path& part : options.parts)
    if (fs::weakly_canonical(part) == fs::weakly_canonical(options.folder))
      return Error{fmt::format("{} holds runs: merge them into another folder", options.folder.string())};
  std::error_code failure;
  fs::create_directories(options.folder, failure);
  if (failure) return Error{fmt::format("cannot make the folder {}: {}", options.folder.string(), failure.message())};
  return {};
}

}  // namespace

Result<MergeReport> mergeOutputs(const MergeOptions& options) {
  const auto parts = Parts::open(options.parts);
  if (!parts) return parts.error();
  if (const Status prepared = prepare(options); !prepared) return prepared.error();
  auto description = caseOf(parts.value().manifest());
  if (!description) return description.error();
  auto terrain = terrainOf(description.value());
  if (!terrain) return terrain.error();
  if (const Status maps = readMaps(description.value(), terrain.value()); !maps) return maps.error();
  if (const Status raised = raiseDams(description.value(), terrain.value()); !raised) return raised.error();
  const auto ground = makeGround(std::move(terrain).value(), description.value().terrain);
  if (!ground) return ground.error();
  Gathered gathered(description.value(), options, parts.value().missing());
  const Status read = parts.value().forEach([&](const RunFile& file) -> Status {
    gathered.add(file, description.value().outputs.rasterCellM);
    return {};
  });
  if (!read) return read.error();
  const std::vector<CollectorFigures> figures = gathered.collectors.figures();
  const auto files = filesOf(description.value(), *ground.value(), gathered, figures);
  if (const Status rasters = writeGeoRasters(options.folder, description.value(), *ground.value(), gathered.merged);
      !rasters)
    return rasters.error();
  if (const Status places = writeGeoTables(
          options, ground.value()->projection(),
          {gathered.places.trajectories(), gathered.places.stops(), collectorsTable(description.value(), figures)});
      !places)
    return places.error();
  auto hash = write(files, parts.value(), options.folder);
  if (!hash) return hash.error();
  if (options.png)
    for (const auto& [name, make] : files)
      if (const fs::path svg = options.folder / name; svg.extension() == ".svg")
        if (const Status drawn = renderSvg(svg, fs::path(svg).replace_extension(".png")); !drawn) return drawn.error();
  const auto lost = gathered.merged.endings[static_cast<std::size_t>(RockEnd::lost)];
  const std::uint64_t runs = gathered.merged.runs;
  return MergeReport{runs,
                     gathered.merged.rocks,
                     lost,
                     gathered.missing,
                     gathered.cpuS,
                     gathered.effects,
                     gathered.merged.effects,
                     checkQuantiles(gathered.runouts, figures, runs),
                     checkCells(gathered.merged),
                     std::move(hash).value()};
}

}  // namespace cairn::rockfall
