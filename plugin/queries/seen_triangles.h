// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace cairn::bullet {

/// Which triangles a query has looked at: a triangle is in every leaf that holds a piece of it.
///
/// The marks are this thread's and used again, so that a query neither allocates nor clears in the long run; a thread
/// keeps four bytes for each triangle of the largest mesh it has asked about. Queries may be begun inside others.
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
