// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rockfall/case/cursor.h"

namespace cairn::rockfall {

/// Index into the case's list of materials.
using MaterialId = std::uint32_t;
using Materials = std::vector<std::string>;
/// Two materials, the smaller index first.
using MaterialPair = std::pair<MaterialId, MaterialId>;

constexpr MaterialPair pairOf(MaterialId a, MaterialId b) {
  return a < b ? MaterialPair{a, b} : MaterialPair{b, a};
}

/// A number for every two materials: the value of their pair where it is listed, else the default.
struct PairTable {
  struct Entry {
    MaterialPair pair;
    double value = 0;
  };
  double otherwise = 0;
  std::vector<Entry> entries;

  /// Linear in the entries.
  double at(MaterialId a, MaterialId b) const;
  double least() const;
  double greatest() const;
};

Materials readMaterials(const Value& value);
/// Reads the name of one of the case's materials.
MaterialId readMaterial(const Value& value, const Materials& materials);
/// Reads a list of two names, which may be equal.
MaterialPair readPair(const Value& value, const Materials& materials);
/// Reads the keys `otherwiseKey` and "pairs", a list of {"materials": [a, b], valueKey: number}. No pair may occur
/// twice.
PairTable readPairTable(Object& object, const Materials& materials, std::string_view otherwiseKey,
                        std::string_view valueKey, const Range& range);

}  // namespace cairn::rockfall
