// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/materials.h"

#include <fmt/format.h>

#include <algorithm>

namespace cairn::rockfall {
namespace {

constexpr std::size_t kMaxMaterials = 256, kMaxPairs = 10000;

}  // namespace

double PairTable::at(MaterialId a, MaterialId b) const {
  const auto entry = std::ranges::find(entries, pairOf(a, b), &Entry::pair);
  return entry == entries.end() ? otherwise : entry->value;
}

double PairTable::least() const {
  double least = otherwise;
  for (const Entry& entry : entries) least = std::min(least, entry.value);
  return least;
}

double PairTable::greatest() const {
  double greatest = otherwise;
  for (const Entry& entry : entries) greatest = std::max(greatest, entry.value);
  return greatest;
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

PairTable readPairTable(Object& object, const Materials& materials, std::string_view otherwiseKey,
                        std::string_view valueKey, const Range& range) {
  PairTable table;
  table.otherwise = object.at(otherwiseKey).number(range);
  const auto pairs = object.find("pairs");
  if (!pairs) return table;
  for (const Value& item : pairs->items(0, kMaxPairs)) {
    Object entry(item);
    const MaterialPair pair = readPair(entry.at("materials"), materials);
    if (std::ranges::find(table.entries, pair, &PairTable::Entry::pair) != table.entries.end())
      item.refuse("this pair of materials is listed twice");
    table.entries.push_back({pair, entry.at(valueKey).number(range)});
  }
  return table;
}

}  // namespace cairn::rockfall
