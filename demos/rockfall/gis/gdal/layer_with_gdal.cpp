// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ogrsf_frmts.h>

#include <array>
#include <cmath>
#include <memory>

#include "rockfall/case/cursor.h"
#include "rockfall/gis/gdal/plane_shapes.h"
#include "rockfall/gis/map_layer.h"
#include "rockfall/terrain/gdal/quiet.h"
#include "rockfall/terrain/gdal/spatial_reference.h"

namespace cairn::rockfall {
namespace {

/// Formats of one file each that hold nothing but features. Others may name files on other machines.
constexpr std::array<const char*, 5> kDrivers{"GeoJSON", "GPKG", "ESRI Shapefile", "FlatGeobuf", nullptr};
constexpr std::int64_t kMaxFeatures = 1000000;
constexpr std::size_t kMaxLayersNamed = 20;

std::vector<OGRLayer*> layersOf(GDALDataset& dataset) {
  std::vector<OGRLayer*> layers;
  for (OGRLayer* layer : dataset.GetLayers())
    if (layer->GetGeomType() != wkbNone) layers.push_back(layer);  // tables without places are no maps
  return layers;
}

Result<OGRLayer*> chosenLayer(GDALDataset& dataset, const std::optional<std::string>& name) {
  const std::vector<OGRLayer*> layers = layersOf(dataset);
  if (layers.empty()) return Error{"holds no layer with places"};
  std::vector<std::string> names;
  for (OGRLayer* layer : layers) {
    names.emplace_back(layer->GetName());
    if (name && names.back() == *name) return layer;
  }
  if (!name && layers.size() == 1) return layers.front();
  if (names.size() > kMaxLayersNamed) names.resize(kMaxLayersNamed);
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  if (name) return Error{fmt::format("has no layer \"{}\": it holds {}", *name, list)};
  return Error{fmt::format("holds {} layers: name one of them as \"layer\": {}", layers.size(), list)};
}

/// The way from a layer's coordinates to the terrain's.
struct Reprojection {
  std::unique_ptr<OGRCoordinateTransformation> transformation;  // null: they are the same
  std::string from;
};

Result<Reprojection> reprojectionOf(const OGRSpatialReference* own, const std::string& terrain) {
  if (!own || own->IsEmpty()) return Reprojection{};
  if (terrain.empty())
    return Error{fmt::format(
        "is in {}, but the terrain does not say in which coordinates it is: give its \"crs\" under /terrain, as in "
        "\"crs\": \"EPSG:2056\"",
        nameOf(*own))};
  OGRSpatialReference from(*own);
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const OGRSpatialReference to = referenceOf(terrain);
  if (isSame(from, to)) return Reprojection{};
  // A way that ignores the difference of two datums may be a hundred metres wrong.
  OGRCoordinateTransformationOptions options;
  options.SetBallparkAllowed(false);
  Reprojection way{std::unique_ptr<OGRCoordinateTransformation>(OGRCreateCoordinateTransformation(&from, &to, options)),
                   nameOf(from)};
  if (way.transformation) return way;
  return Error{
      fmt::format("is in {}, and there is no exact way from there to the terrain's {}: reproject it first, "
                  "for example by ogr2ogr -t_srs",
                  nameOf(from), nameOf(to))};
}

Result<int> fieldOf(OGRLayer& layer, const std::string& name) {
  if (name.empty()) return -1;
  OGRFeatureDefn& definition = *layer.GetLayerDefn();
  const int index = definition.GetFieldIndex(name.c_str());
  if (index >= 0) return index;
  std::vector<std::string> names;
  for (int i = 0; i < definition.GetFieldCount(); ++i) names.emplace_back(definition.GetFieldDefn(i)->GetNameRef());
  return Error{fmt::format("has no field \"{}\": {}", name,
                           names.empty() ? "it has none" : fmt::format("it has {}", fmt::join(names, ", ")))};
}

bool looksNoDegrees(OGRLayer& layer, const OGRGeometry& geometry) {
  const OGRSpatialReference* const reference = layer.GetSpatialRef();
  OGREnvelope box;
  geometry.getEnvelope(&box);
  return reference && reference->IsGeographic() &&
         (std::max(std::abs(box.MinX), std::abs(box.MaxX)) > 360 ||
          std::max(std::abs(box.MinY), std::abs(box.MaxY)) > 90);
}

/// Reads the features of a layer one by one.
class LayerReader {
 public:
  LayerReader(OGRLayer& layer, OGRCoordinateTransformation* reprojection, int field)
      : layer_(layer), reprojection_(reprojection), field_(field) {}

  Result<MapLayer> read() {
    layer_.ResetReading();
    CPLErrorReset();
    while (const OGRFeatureUniquePtr feature{layer_.GetNextFeature()}) {
      if (static_cast<std::int64_t>(map_.features.size()) == kMaxFeatures)
        return Error{fmt::format("holds more than {} features: cut out what the terrain covers", kMaxFeatures)};
      if (const Status added = add(*feature); !added)
        return Error{fmt::format("feature {}: {}", feature->GetFID(), added.error().message)};
      CPLErrorReset();
    }
    if (CPLGetLastErrorType() >= CE_Failure) return Error{"cannot be read to its end: " + Quiet::said()};
    return std::move(map_);
  }

 private:
  Status add(OGRFeature& feature) {
    const std::unique_ptr<OGRGeometry> geometry(feature.StealGeometry());
    if (!geometry || geometry->IsEmpty()) {
      ++map_.withoutPlace;
      return {};
    }
    if (looksNoDegrees(layer_, *geometry))
      return Error{
          "its coordinates are no degrees, though the file says so, or says nothing as GeoJSON does: write it with its "
          "coordinate system, for example by ogr2ogr -a_srs"};
    MapFeature& added = map_.features.emplace_back();
    added.id = feature.GetFID();
    if (field_ >= 0 && feature.IsFieldSetAndNotNull(field_)) added.text = feature.GetFieldAsString(field_);
    return addShapes(*geometry, reprojection_, added);
  }

  OGRLayer& layer_;
  OGRCoordinateTransformation* reprojection_;
  int field_;
  MapLayer map_;
};

Result<MapLayer> readOpen(GDALDataset& dataset, const LayerRequest& request) {
  const auto layer = chosenLayer(dataset, request.layer);
  if (!layer) return layer.error();
  const auto field = fieldOf(*layer.value(), request.field);
  if (!field) return field.error();
  const auto reprojection = reprojectionOf(layer.value()->GetSpatialRef(), request.projection);
  if (!reprojection) return reprojection.error();
  auto map = LayerReader(*layer.value(), reprojection.value().transformation.get(), field.value()).read();
  if (map) map.value().reprojectedFrom = reprojection.value().from;
  return map;
}

}  // namespace

Result<MapLayer> readMapLayer(const LayerRequest& request) {
  const std::string file = request.file.string();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(request.file, ignored)) return Error{file + " is no file that can be read"};
  const Quiet quiet;
  const Dataset dataset(
      GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, kDrivers.data(), nullptr, nullptr));
  if (!dataset)
    return Error{inOneLine(file + " cannot be read as GeoJSON, GeoPackage, shapefile or FlatGeobuf: " + Quiet::said())};
  auto map = readOpen(*dataset, request);
  if (!map) return Error{inOneLine(file + " " + map.error().message)};
  return map;
}

}  // namespace cairn::rockfall
