// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/case.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/atomic_file.h"
#include "rockfall/case/content_hash.h"
#include "rockfall/case/effects_section.h"

namespace cairn::rockfall {
namespace {

BudgetSection readBudget(const Value& value) {
  Object object(value);
  BudgetSection budget;
  if (const auto operations = object.find("operations"))
    budget.operations = operations->whole(0, std::uint64_t{1} << 53);
  if (const auto time = object.find("microseconds")) budget.microseconds = time->number(between(0, 1e9));
  return budget;
}

Case readSections(const Value& value) {
  Object object(value);
  Case scene;
  scene.name = object.at("case").name();
  scene.seed = object.at("seed").whole(0, std::uint64_t{1} << 53);
  scene.stepS = object.at("step_s").number({1e-5, 0.1});
  const Value duration = object.at("duration_s");
  scene.durationS = duration.number({0, 86400, true});
  if (constexpr double kMaxSteps = 1e8; scene.durationS > kMaxSteps * scene.stepS)
    duration.refuse("that would be more than a hundred million steps: use longer steps or a shorter time");
  scene.gravityMPerS2 = object.numberOr("gravity_m_per_s2", between(0, 1000), scene.gravityMPerS2);
  if (const auto budget = object.find("budget")) scene.budget = readBudget(*budget);
  scene.materials = readMaterials(object.at("materials"));
  scene.terrain = readTerrain(object.at("terrain"), scene.materials);
  scene.rocks = readRocks(object.at("rocks"), scene.materials);
  scene.effects = readEffects(object.at("effects"), scene.materials);
  if (const auto collectors = object.find("collectors")) scene.collectors = readCollectors(*collectors);
  if (const auto outputs = object.find("outputs")) scene.outputs = readOutputs(*outputs);
  return scene;
}

struct NamedFile {
  std::string path;  // in the case
  std::string file;
  bool isMap = false;
};

std::vector<NamedFile> namedFiles(const Case& scene) {
  std::vector<NamedFile> files;
  if (const auto* raster = std::get_if<RasterTerrain>(&scene.terrain.source))
    files.push_back({"/terrain/raster", raster->file, true});
  if (const auto* mesh = std::get_if<MeshTerrain>(&scene.terrain.source))
    files.push_back({"/terrain/mesh", mesh->file});
  for (std::size_t i = 0; i < scene.rocks.size(); ++i)
    if (const auto* mesh = std::get_if<MeshRocks>(&scene.rocks[i].source))
      files.push_back({pathInto("/rocks", i) + "/mesh", mesh->file});
  for (const MapSource* map : mapsOf(scene))
    files.push_back({map->path + (map->isRaster ? "/raster" : "/vector"), map->file, true});
  return files;
}

/// What belongs to a map's file decides what is read of it.
Status addToHash(ContentHash& hash, const Case& scene, const NamedFile& named) {
  const auto content = readFile(scene.pathOf(named.file));
  if (!content) return content.error();
  hash.add(content.value());
  if (!named.isMap) return {};
  for (const std::string& beside : filesBesideMap(named.file))
    if (std::filesystem::exists(scene.pathOf(beside))) {
      const auto more = readFile(scene.pathOf(beside));
      if (!more) return more.error();
      hash.add(beside);
      hash.add(more.value());
    }
  return {};
}

}  // namespace

std::vector<const MapSource*> mapsOf(const Case& scene) {
  std::vector<const MapSource*> maps;
  for (const MappedZones& zones : scene.terrain.mapped) maps.push_back(&zones.map);
  for (const Dam& dam : scene.terrain.dams)
    if (dam.map) maps.push_back(&*dam.map);
  for (const RockGroup& group : scene.rocks)
    if (group.release.map) maps.push_back(&*group.release.map);
  for (const Collector& collector : scene.collectors)
    if (collector.map) maps.push_back(&*collector.map);
  for (const EffectOptions& effect : scene.effects) {
    if (const auto* barrier = std::get_if<BarrierOptions>(&effect); barrier && barrier->map)
      maps.push_back(&*barrier->map);
    if (const auto* trees = std::get_if<TreesOptions>(&effect))
      if (const auto* mapped = std::get_if<MappedTrees>(&trees->stems)) maps.push_back(&mapped->map);
  }
  return maps;
}

std::uint32_t Case::stepCount() const {
  return static_cast<std::uint32_t>(std::max(1.0, std::round(durationS / stepS)));
}

Result<Case> parseCase(std::string_view text, const std::string& file, const std::filesystem::path& folder) {
  const auto document = parseDocument(text, file);
  if (!document) return document.error();
  Complaint complaint(file);
  Case scene = readSections(Value(&document.value(), "", complaint));
  if (complaint.first()) return Error{*complaint.first()};
  scene.folder = folder;
  ContentHash hash;
  hash.add(document.value().dump());
  for (const NamedFile& named : namedFiles(scene)) {
    const Status added = addToHash(hash, scene, named);
    if (!added) return Error{inOneLine(file + ": " + named.path + ": " + added.error().message)};
  }
  scene.hash = hash.hex();
  return scene;
}

Result<Case> readCase(const std::filesystem::path& path) {
  const auto content = readFile(path);
  if (!content) return content.error();
  const std::string_view text(reinterpret_cast<const char*>(content.value().data()), content.value().size());
  return parseCase(text, path.string(), path.parent_path());
}

}  // namespace cairn::rockfall
