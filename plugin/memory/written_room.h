// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <vector>

namespace cairn::bullet {

/// Room for so many elements, in memory that has been written to: a page's first write takes as long as a pair. The
/// list's elements stay.
template <class Element>
void makeWrittenRoom(std::vector<Element>& list, std::size_t count) {
  if (list.capacity() >= count) return;
  const std::size_t size = list.size();
  list.resize(count);
  list.resize(size);
}

}  // namespace cairn::bullet
