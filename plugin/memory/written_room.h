// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <vector>

namespace cairn::bullet {

/// Reserves room for so many elements in memory that has been written to. The first write to a page takes as long as a
/// pair. The list keeps its elements.
template <class Element>
void makeWrittenRoom(std::vector<Element>& list, std::size_t count) {
  if (list.capacity() >= count) return;
  const std::size_t size = list.size();
  list.resize(count);
  list.resize(size);
}

}  // namespace cairn::bullet
