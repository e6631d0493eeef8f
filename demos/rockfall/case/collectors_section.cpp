// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/collectors_section.h"

#include <fmt/format.h>

#include <algorithm>

namespace cairn::rockfall {

std::vector<Collector> readCollectors(const Value& value) {
  constexpr std::size_t kMaxCollectors = 1000;
  std::vector<Collector> collectors;
  for (const Value& item : value.items(0, kMaxCollectors)) {
    Object object(item);
    const Value name = object.at("name");
    Collector collector{name.name(), {}, {}};
    if (std::ranges::find(collectors, collector.name, &Collector::name) != collectors.end())
      name.refuse(fmt::format("the collector \"{}\" is listed twice", collector.name));
    PlacedLines placed = readLines(object);
    collector.lines = std::move(placed.lines);
    collector.map = std::move(placed.map);
    collectors.push_back(collector);
  }
  return collectors;
}

}  // namespace cairn::rockfall
