// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_program.h"

namespace cairn::test {

/// Whether GDAL's own programs are there, which judge what ours read and write.
inline bool hasGdalPrograms() {
  return std::system("ogr2ogr --version > /dev/null 2>&1 && gdalinfo --version > /dev/null 2>&1") == 0;
}

/// A feature of a map to be written: its geometry as GeoJSON has it, its fields.
struct FeatureToWrite {
  nlohmann::json geometry, fields = nlohmann::json::object();
};

inline nlohmann::json pointAt(double x, double y) {
  return {{"type", "Point"}, {"coordinates", {x, y}}};
}
inline nlohmann::json lineOf(const std::vector<std::vector<double>>& corners) {
  return {{"type", "LineString"}, {"coordinates", corners}};
}
/// A rectangle from one corner to the other, maybe with a hole.
inline nlohmann::json rectangle(double x0, double y0, double x1, double y1,
                                const std::vector<std::vector<double>>& hole = {}) {
  nlohmann::json rings = {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}};
  if (!hole.empty()) rings.push_back(hole);
  return {{"type", "Polygon"}, {"coordinates", rings}};
}

/// GeoJSON in the Swiss national coordinates, or in others by their EPSG number, or (0) without any.
inline void writeMap(const std::filesystem::path& file, const std::vector<FeatureToWrite>& features, int epsg = 2056) {
  nlohmann::json json{{"type", "FeatureCollection"}, {"features", nlohmann::json::array()}};
  if (epsg != 0)
    json["crs"] = {{"type", "name"}, {"properties", {{"name", fmt::format("urn:ogc:def:crs:EPSG::{}", epsg)}}}};
  for (const FeatureToWrite& feature : features)
    json["features"].push_back({{"type", "Feature"}, {"properties", feature.fields}, {"geometry", feature.geometry}});
  std::ofstream(file) << json.dump();
}

/// Runs a program of GDAL and gives what it printed. A failure of it is one of the test.
inline std::string gdal(const std::string& command) {
  const TemporaryFolder folder;
  const auto output = folder.path() / "output";
  EXPECT_EQ(std::system((command + " > '" + output.string() + "' 2>&1").c_str()), 0) << command << "\n"
                                                                                     << contentOf(output);
  return contentOf(output);
}

}  // namespace cairn::test
