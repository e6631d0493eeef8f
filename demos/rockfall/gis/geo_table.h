// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::rockfall {

/// A field of a table: its name with its unit, and the kind of its values.
struct GeoField {
  enum class Kind : std::uint8_t { whole, real, text };
  std::string name;
  Kind kind = Kind::real;
};

/// A row: its places on the map, and one value for each field.
struct GeoRow {
  using Value = std::variant<std::int64_t, double, std::string>;  ///< in the order of `GeoField::Kind`
  std::vector<std::vector<Vec3d>> parts;  ///< one part of one place where the table holds points
  std::vector<Value> values;
};

/// A table with places, as a geographic information system has it. The same fields in all rows.
struct GeoTable {
  std::string name;
  bool hasPoints = false;  ///< else lines, each row of one part or several
  std::vector<GeoField> fields;
  std::vector<GeoRow> rows;
};

/// Writes tables as the layers of one GeoPackage, completely or not at all. `projection` is WKT, empty where it is not
/// known. Fails in one sentence that names the file; without GDAL always.
Status writeGeoPackage(const std::filesystem::path& path, const std::vector<GeoTable>& tables,
                       const std::string& projection);

/// Writes a table as GeoJSON, completely or not at all. Coordinates are those of the projection, which stands in the
/// file's member "crs", in place of degrees. Fails as above.
Status writeGeoJson(const std::filesystem::path& path, const GeoTable& table, const std::string& projection);

}  // namespace cairn::rockfall
