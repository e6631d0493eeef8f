// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cpl_error.h>
#include <gdal_priv.h>

#include <algorithm>
#include <memory>
#include <string>

namespace cairn::rockfall {

/// Suppresses GDAL's output while it exists; the message becomes part of our sentence. Registers GDAL's formats.
class Quiet {
 public:
  Quiet() {
    static const bool isRegistered = (GDALAllRegister(), true);
    static_cast<void>(isRegistered);
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~Quiet() { CPLPopErrorHandler(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

  static std::string said() {
    std::string text = CPLGetLastErrorMsg();
    std::ranges::replace(text, '\n', ' ');
    return text.empty() ? "no reason given" : text;
  }
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

}  // namespace cairn::rockfall
