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
    Collector collector{name.name(), {}};
    if (std::ranges::find(collectors, collector.name, &Collector::name) != collectors.end())
      name.refuse(fmt::format("the collector \"{}\" is listed twice", collector.name));
    const Value line = object.at("line_m");
    if (const auto ends = line.items(2, 2); ends.size() == 2) {
      collector.line = {readPoint(ends[0]), readPoint(ends[1])};
      if (collector.line[0] == collector.line[1]) line.refuse("the ends of the line are the same point");
    }
    collectors.push_back(collector);
  }
  return collectors;
}

}  // namespace cairn::rockfall
