// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/materials.h"

#include <fmt/format.h>

#include <algorithm>

namespace cairn::rockfall {
namespace {

constexpr std::size_t kMaxMaterials = 256, kMaxPairs = 10000;

}  // namespace

Span PairTable::at(MaterialId a, MaterialId b) const {
  const auto entry = std::ranges::find(entries, pairOf(a, b), &Entry::pair);
  return entry == entries.end() ? otherwise : entry->value;
}

Materials readMaterials(const Value& value) {
  Materials materials;
  for (const Value& item : value.items(1, kMaxMaterials)) {
    const std::string name = item.name();
    if (!name.empty() && std::ranges::find(materials, name) != materials.end())
      item.refuse(fmt::format("the material \"{}\" is listed twice", name));
    materials.push_back(name);
  }
  return materials;
}

MaterialId readMaterial(const Value& value, const Materials& materials) {
  const std::string name = value.name();
  const auto found = std::ranges::find(materials, name);
  if (found != materials.end()) return static_cast<MaterialId>(found - materials.begin());
  const auto near = nearestWord(name, materials);
  if (!name.empty())
    value.refuse(fmt::format("the material \"{}\" is not listed under /materials{}", name,
                             near ? fmt::format(" (did you mean \"{}\"?)", *near) : ""));
  return 0;
}

MaterialPair readPair(const Value& value, const Materials& materials) {
  const auto names = value.items(2, 2);
  if (names.size() != 2) return {};
  const MaterialId first = readMaterial(names[0], materials);
  return pairOf(first, readMaterial(names[1], materials));
}

Span readSpan(const Value& value, const Range& range) {
  if (!value.isArray()) {
    const double number = value.number(range);
    return {number, number};
  }
  const auto ends = value.items(2, 2);
  if (ends.size() != 2) return {};
  const Span span{ends[0].number(range), ends[1].number(range)};
  if (span.high < span.low) value.refuse("the smaller value comes first");
  return span;
}

PairTable readPairTable(Object& object, const Materials& materials, std::string_view otherwiseKey, const Range& range,
                        const std::function<void(Object&, PairTable::Entry&)>& readEntry) {
  PairTable table;
  table.otherwise = readSpan(object.at(otherwiseKey), range);
  const auto pairs = object.find("pairs");
  if (!pairs) return table;
  for (const Value& item : pairs->items(0, kMaxPairs)) {
    Object pair(item);
    PairTable::Entry entry{readPair(pair.at("materials"), materials), {}, {}};
    if (std::ranges::find(table.entries, entry.pair, &PairTable::Entry::pair) != table.entries.end())
      item.refuse("this pair of materials is listed twice");
    readEntry(pair, entry);
    table.entries.push_back(entry);
  }
  return table;
}

PairTable readPairTable(Object& object, const Materials& materials, std::string_view otherwiseKey,
                        std::string_view valueKey, const Range& range) {
  return readPairTable(object, materials, otherwiseKey, range, [&](Object& pair, PairTable::Entry& entry) {
    entry.value = readSpan(pair.at(valueKey), range);
  });
}

}  // namespace cairn::rockfall
