// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_conv.h>
#include <cpl_string.h>

#include <array>
#include <cmath>

#include "rockfall/terrain/gdal/quiet.h"
#include "rockfall/terrain/gdal/spatial_reference.h"
#include "rockfall/terrain/projection.h"

namespace cairn::rockfall {
namespace {

constexpr int kSureMatch = 90;  // per cent, as GDAL's own drivers ask for

std::string owned(char* text) {
  std::string copy = text == nullptr ? "" : text;
  CPLFree(text);
  return copy;
}

}  // namespace

Status checkUnits(const OGRSpatialReference* reference) {
  if (!reference) return {};
  if (reference->IsGeographic())
    return Error{"is in degrees: project it to metres first, for example by gdalwarp -t_srs EPSG:25832"};
  if (reference->IsProjected() && std::abs(reference->GetLinearUnits() - 1) > 1e-9)
    return Error{"is in a unit of " + std::to_string(reference->GetLinearUnits()) + " m: project it to metres first"};
  return {};
}

OGRSpatialReference referenceOf(const std::string& projection) {
  OGRSpatialReference reference;
  if (!projection.empty()) reference.importFromWkt(projection.c_str());
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

std::string projectionOf(const OGRSpatialReference* reference) {
  char* text = nullptr;
  if (!reference || reference->IsEmpty() || reference->exportToWkt(&text) != OGRERR_NONE) {
    CPLFree(text);
    return {};
  }
  return owned(text);
}

bool isSame(const OGRSpatialReference& a, const OGRSpatialReference& b) {
  static constexpr std::array<const char*, 3> kOptions{"CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS",
                                                       "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr};
  return !a.IsEmpty() && !b.IsEmpty() && a.IsSame(&b, kOptions.data());
}

std::string nameOf(const OGRSpatialReference& reference) {
  const char* const authority = reference.GetAuthorityName(nullptr);
  const char* const code = reference.GetAuthorityCode(nullptr);
  if (authority && code) return std::string(authority) + ":" + code;
  const char* const name = reference.GetName();
  return name ? "\"" + std::string(name) + "\"" : "a projection without a name";
}

Result<std::string> projectionNamed(const std::string& name) {
  const Quiet quiet;
  OGRSpatialReference reference;
  // Names may be addresses of files and of other machines, which are not looked at.
  if (reference.SetFromUserInput(name.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) !=
      OGRERR_NONE)
    return Error{"is no coordinate system that is known: give a name such as EPSG:2056"};
  if (const Status units = checkUnits(&reference); !units) return units.error();
  return projectionOf(&reference);
}

Result<std::string> projectionOfPrj(const std::string& text) {
  const Quiet quiet;
  OGRSpatialReference reference;
  CPLStringList lines(CSLTokenizeString2(text.c_str(), "\r\n", 0));  // without empty ones
  if (reference.importFromESRI(lines.List()) != OGRERR_NONE)
    return Error{"holds no coordinate system that can be read: " + Quiet::said()};
  if (const Status units = checkUnits(&reference); !units) return units.error();
  // The same one by its number, which ESRI's text does not hold.
  OGRSpatialReference* const known = reference.FindBestMatch(kSureMatch);
  std::string projection = projectionOf(known ? known : &reference);
  if (known) known->Release();
  return projection;
}

std::string prjOf(const std::string& projection) {
  if (projection.empty()) return {};
  const Quiet quiet;
  static constexpr std::array<const char*, 2> kEsri{"FORMAT=WKT1_ESRI", nullptr};
  char* text = nullptr;
  if (referenceOf(projection).exportToWkt(&text, kEsri.data()) != OGRERR_NONE) {
    CPLFree(text);
    return projection;
  }
  return owned(text);
}

bool isSameProjection(const std::string& a, const std::string& b) {
  const Quiet quiet;
  return isSame(referenceOf(a), referenceOf(b));
}

std::string nameOfProjection(const std::string& projection) {
  const Quiet quiet;
  return nameOf(referenceOf(projection));
}

}  // namespace cairn::rockfall
