// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_string.h>
#include <ogrsf_frmts.h>

#include <array>
#include <memory>
#include <span>

#include "cairn/core/atomic_file.h"
#include "rockfall/gis/geo_table.h"
#include "rockfall/terrain/gdal/quiet.h"
#include "rockfall/terrain/gdal/spatial_reference.h"

namespace cairn::rockfall {
namespace {

std::unique_ptr<OGRGeometry> geometryOf(const GeoTable& table, const GeoRow& row) {
  if (table.hasPoints) {
    const Vec3d& place = row.parts.front().front();
    return std::make_unique<OGRPoint>(place.x, place.y, place.z);
  }
  auto lines = std::make_unique<OGRMultiLineString>();
  for (const std::vector<Vec3d>& part : row.parts) {
    auto line = std::make_unique<OGRLineString>();
    for (const Vec3d& place : part) line->addPoint(place.x, place.y, place.z);
    lines->addGeometryDirectly(line.release());
  }
  return lines;
}

void setField(OGRFeature& feature, int field, const GeoRow::Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) feature.SetField(field, GIntBig(*whole));
  if (const auto* real = std::get_if<double>(&value)) feature.SetField(field, *real);
  if (const auto* text = std::get_if<std::string>(&value)) feature.SetField(field, text->c_str());
}

Status addRows(OGRLayer& layer, const GeoTable& table) {
  static constexpr std::array kTypes{OFTInteger64, OFTReal, OFTString};
  for (const GeoField& field : table.fields) {
    OGRFieldDefn definition(field.name.c_str(), kTypes[static_cast<std::size_t>(field.kind)]);
    if (layer.CreateField(&definition) != OGRERR_NONE) return Error{Quiet::said()};
  }
  for (const GeoRow& row : table.rows) {
    OGRFeature feature(layer.GetLayerDefn());
    for (std::size_t i = 0; i < row.values.size(); ++i) setField(feature, static_cast<int>(i), row.values[i]);
    feature.SetGeometryDirectly(geometryOf(table, row).release());
    if (layer.CreateFeature(&feature) != OGRERR_NONE) return Error{Quiet::said()};
  }
  return {};
}

Status addTable(GDALDataset& dataset, const GeoTable& table, const std::string& projection, CSLConstList options) {
  OGRSpatialReference reference = referenceOf(projection);
  const OGRwkbGeometryType type = table.hasPoints ? wkbPoint25D : wkbMultiLineString25D;
  OGRLayer* const layer = dataset.CreateLayer(table.name.c_str(), projection.empty() ? nullptr : &reference, type,
                                              const_cast<char**>(options));
  if (!layer) return Error{Quiet::said()};
  // One transaction for all rows: each on its own would wait for the disk.
  const bool hasTransaction = dataset.TestCapability(ODsCTransactions);
  if (hasTransaction && dataset.StartTransaction() != OGRERR_NONE) return Error{Quiet::said()};
  if (const Status added = addRows(*layer, table); !added) return added;
  if (hasTransaction && dataset.CommitTransaction() != OGRERR_NONE) return Error{Quiet::said()};
  return {};
}

Status writeTo(const std::filesystem::path& path, const char* format, std::span<const GeoTable> tables,
               const std::string& projection, CSLConstList options) {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(format);
  if (!driver) return Error{std::string("this GDAL knows no ") + format};
  Dataset dataset(driver->Create(path.string().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) return Error{Quiet::said()};
  for (const GeoTable& table : tables)
    if (const Status added = addTable(*dataset, table, projection, options); !added) return added;
  CPLErrorReset();
  dataset.reset();  // flushes; it has no other way to report that it could not
  if (CPLGetLastErrorType() >= CE_Failure) return Error{Quiet::said()};
  return {};
}

Status write(const std::filesystem::path& path, const char* format, std::span<const GeoTable> tables,
             const std::string& projection, CSLConstList options) {
  const Quiet quiet;
  const Status status = writeFileAtomically(path, [&](const std::filesystem::path& temporary) -> Status {
    return writeTo(temporary, format, tables, projection, options);
  });
  if (!status) return Error{path.string() + ": cannot be written as " + format + ": " + status.error().message};
  return {};
}

}  // namespace

Status writeGeoPackage(const std::filesystem::path& path, const std::vector<GeoTable>& tables,
                       const std::string& projection) {
  return write(path, "GPKG", tables, projection, nullptr);
}

Status writeGeoJson(const std::filesystem::path& path, const GeoTable& table, const std::string& projection) {
  static constexpr std::array<const char*, 2> kTenthsOfMillimetres{"COORDINATE_PRECISION=4", nullptr};
  return write(path, "GeoJSON", {&table, 1}, projection, kTenthsOfMillimetres.data());
}

}  // namespace cairn::rockfall
