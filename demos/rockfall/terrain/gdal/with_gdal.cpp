// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_string.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "cairn/core/atomic_file.h"
#include "rockfall/terrain/gdal/quiet.h"
#include "rockfall/terrain/gdal/spatial_reference.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall {

namespace {

constexpr double kSquare = 1e-6;  // largest relative difference of a cell's sides

// The positions of rows and columns; `way` is +1 where rows go north.
struct GeoFrame {
  double cell = 1, x = 0, y = 0;
  bool isNorthUp = true;
};

Result<GeoFrame> frameOf(GDALDataset& dataset) {
  std::array<double, 6> t{};
  if (dataset.GetGeoTransform(t.data()) != CE_None) return Error{"does not say where it is: it has no georeference"};
  if (t[2] != 0 || t[4] != 0) return Error{"is turned against north: warp it to a north-up grid first"};
  if (!(t[1] > 0) || std::abs(std::abs(t[5]) - t[1]) > kSquare * t[1] || !std::isfinite(t[0]) || !std::isfinite(t[3]))
    return Error{"has cells of " + std::to_string(t[1]) + " x " + std::to_string(std::abs(t[5])) +
                 " m: warp it to square ones first"};
  const bool isNorthUp = t[5] < 0;
  const double first = isNorthUp ? t[3] - (dataset.GetRasterYSize() - 0.5) * t[1] : t[3] + 0.5 * t[1];
  return GeoFrame{t[1], t[0] + 0.5 * t[1], first, isNorthUp};
}

Status readBand(GDALRasterBand& band, bool isNorthUp, Raster& raster) {
  int hasNoData = 0, hasScale = 0, hasOffset = 0;
  const double noData = band.GetNoDataValue(&hasNoData);
  const double scale = band.GetScale(&hasScale), offset = band.GetOffset(&hasOffset);
  const int columns = static_cast<int>(raster.columns), rows = static_cast<int>(raster.rows);
  for (int line = 0; line < rows; ++line) {
    const auto row = static_cast<std::uint32_t>(isNorthUp ? rows - 1 - line : line);
    double* const values = &raster.at(0, row);
    if (band.RasterIO(GF_Read, 0, line, columns, 1, values, columns, 1, GDT_Float64, 0, 0, nullptr) != CE_None)
      return Error{"cannot be read in its row " + std::to_string(line) + ": " + Quiet::said()};
    for (double& value : std::span(values, raster.columns)) {
      if (hasNoData && value == noData) value = std::numeric_limits<double>::quiet_NaN();
      if (std::isinf(value)) return Error{"holds an infinite value in its row " + std::to_string(line)};
      if (hasScale || hasOffset) value = value * (hasScale ? scale : 1) + (hasOffset ? offset : 0);
    }
  }
  return {};
}

Result<Raster> readOpen(GDALDataset& dataset) {
  if (dataset.GetRasterCount() < 1) return Error{"holds no raster"};
  const auto columns = static_cast<std::uint64_t>(std::max(dataset.GetRasterXSize(), 0));
  const auto rows = static_cast<std::uint64_t>(std::max(dataset.GetRasterYSize(), 0));
  if (Status status = checkRasterSize(columns, rows); !status) return status.error();
  if (Status status = checkUnits(dataset.GetSpatialRef()); !status) return status.error();
  const Result<GeoFrame> frame = frameOf(dataset);
  if (!frame) return frame.error();
  const GeoFrame& f = frame.value();
  Raster raster{static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), f.cell, f.x, f.y, {}, {}};
  raster.values.resize(columns * rows);
  raster.projection = dataset.GetProjectionRef();
  if (Status status = readBand(*dataset.GetRasterBand(1), f.isNorthUp, raster); !status) return status.error();
  return raster;
}

bool areFloats(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double v) { return std::isnan(v) || double(static_cast<float>(v)) == v; });
}

Status writeTo(const std::filesystem::path& path, const Raster& raster, const BandText& text) {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (!driver) return Error{"this GDAL knows no GeoTIFF"};
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  const int columns = static_cast<int>(raster.columns), rows = static_cast<int>(raster.rows);
  const GDALDataType type = areFloats(raster.values) ? GDT_Float32 : GDT_Float64;
  Dataset dataset(driver->Create(path.string().c_str(), columns, rows, 1, type, options.List()));
  if (!dataset) return Error{Quiet::said()};
  std::array<double, 6> t{raster.x - 0.5 * raster.cell,          raster.cell, 0,
                          raster.y + (rows - 0.5) * raster.cell, 0,           -raster.cell};
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  bool isFine = dataset->SetGeoTransform(t.data()) == CE_None &&
                band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN()) == CE_None;
  if (!raster.projection.empty()) isFine = isFine && dataset->SetProjection(raster.projection.c_str()) == CE_None;
  if (!text.description.empty()) band.SetDescription(text.description.c_str());
  if (!text.unit.empty()) isFine = isFine && band.SetUnitType(text.unit.c_str()) == CE_None;
  for (int line = 0; isFine && line < rows; ++line) {
    std::vector<double> values(raster.columns);
    std::copy_n(&raster.values[std::size_t(rows - 1 - line) * raster.columns], raster.columns, values.begin());
    isFine =
        band.RasterIO(GF_Write, 0, line, columns, 1, values.data(), columns, 1, GDT_Float64, 0, 0, nullptr) == CE_None;
  }
  CPLErrorReset();
  dataset.reset();  // flushes; it has no other way to report that it could not
  if (!isFine || CPLGetLastErrorType() >= CE_Failure) return Error{Quiet::said()};
  return {};
}

}  // namespace

bool hasGdal() {
  return true;
}

Result<Raster> readByGdal(const std::filesystem::path& path) {
  std::error_code ignored;
  // GDAL interprets names as addresses of many kinds, some on other machines.
  if (!std::filesystem::is_regular_file(path, ignored)) return Error{path.string() + ": is no file that can be read"};
  const Quiet quiet;
  const Dataset dataset(static_cast<GDALDataset*>(
      GDALOpenEx(path.string().c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr)));
  if (!dataset) return Error{path.string() + ": GDAL cannot read it: " + Quiet::said()};
  Result<Raster> raster = readOpen(*dataset);
  if (!raster) return Error{path.string() + " " + raster.error().message};
  return raster;
}

Status writeGeoTiff(const std::filesystem::path& path, const Raster& raster, const BandText& text) {
  const Quiet quiet;
  const Status status = writeFileAtomically(
      path, [&](const std::filesystem::path& temporary) -> Status { return writeTo(temporary, raster, text); });
  if (!status) return Error{path.string() + ": cannot be written as GeoTIFF: " + status.error().message};
  return {};
}

}  // namespace cairn::rockfall
