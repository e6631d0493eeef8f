// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/scans.h"

#include <algorithm>

namespace cairn::accuracy_cost {

const std::vector<std::string> kNamedScans{"bunny", "dragon"};

Scans scansOf(const Table& table) {
  const std::vector<std::string> models = table.texts("model");
  Scans scans;
  for (const std::string& name : kNamedScans) {
    const bool isThere = std::ranges::find(models, name) != models.end();
    (isThere ? scans.measured : scans.lacking).emplace_back(name);
  }
  return scans;
}

}  // namespace cairn::accuracy_cost
