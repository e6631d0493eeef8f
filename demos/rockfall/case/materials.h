// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
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

/// A number, or two, between which every run draws its own.
struct Span {
  double low = 0, high = 0;

  bool operator==(const Span&) const = default;
};

/// A number for every two materials: the value of their pair where it is listed, else the default.
struct PairTable {
  struct Entry {
    MaterialPair pair;
    Span value;
    std::string_view soil;  ///< the class that it is of, if any
  };
  Span otherwise;
  std::vector<Entry> entries;

  /// Linear in the entries.
  Span at(MaterialId a, MaterialId b) const;
};

Materials readMaterials(const Value& value);
/// Reads the name of one of the case's materials.
MaterialId readMaterial(const Value& value, const Materials& materials);
/// Reads a list of two names, which may be equal.
MaterialPair readPair(const Value& value, const Materials& materials);
/// Reads a number, or a list of two, the smaller first.
Span readSpan(const Value& value, const Range& range);
/// Reads the keys `otherwiseKey`, a span, and "pairs", a list of {"materials": [a, b]} and what `readEntry` reads into
/// the entry. No pair may occur twice.
PairTable readPairTable(Object& object, const Materials& materials, std::string_view otherwiseKey, const Range& range,
                        const std::function<void(Object&, PairTable::Entry&)>& readEntry);
/// The same with a span under `valueKey`.
PairTable readPairTable(Object& object, const Materials& materials, std::string_view otherwiseKey,
                        std::string_view valueKey, const Range& range);

}  // namespace cairn::rockfall
