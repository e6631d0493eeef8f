// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace cairn::bullet {

/// Records which triangles a query has tested, because every leaf with a piece of a triangle lists it.
///
///     SeenTriangles seen(tree.triangles().size());
///     if (seen.insert(triangle)) test(triangle);
///
/// The marks belong to the thread and are reused, so that a query neither allocates nor clears in the long run. A
/// thread keeps four bytes for each triangle of the largest mesh it has queried. Queries may run inside others.
class SeenTriangles {
 public:
  explicit SeenTriangles(std::size_t triangles);
  ~SeenTriangles();
  SeenTriangles(const SeenTriangles&) = delete;
  SeenTriangles& operator=(const SeenTriangles&) = delete;

  /// True the first time.
  bool insert(std::uint32_t triangle) {
    if (at_[triangle] == query_) return false;
    at_[triangle] = query_;
    return true;
  }

 private:
  struct Marks;

  std::unique_ptr<Marks> marks_;
  std::uint32_t* at_;
  std::uint32_t query_;
};

}  // namespace cairn::bullet
