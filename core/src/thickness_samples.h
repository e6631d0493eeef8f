// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

namespace cairn {

/// How thick a body is behind one face.
struct ThicknessSample {
  float thickness, area;
};

/// What a tenth of the area is thinner than; infinite without samples. Sorts them.
float thinnestTenth(std::vector<ThicknessSample>& samples);

}  // namespace cairn
