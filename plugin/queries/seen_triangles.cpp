// SPDX-License-Identifier: Zlib
#include "queries/seen_triangles.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace cairn::bullet {

struct SeenTriangles::Marks {
  std::vector<std::uint32_t> lastQuery;  // by triangle; 0: none
  std::uint32_t queries = 0;
};

namespace {

// One for each query that runs inside another.
template <class Marks>
std::vector<std::unique_ptr<Marks>>& idleMarks() {
  thread_local std::vector<std::unique_ptr<Marks>> idle;
  return idle;
}

}  // namespace

SeenTriangles::SeenTriangles(std::size_t triangles) {
  auto& idle = idleMarks<Marks>();
  if (idle.empty()) {
    marks_ = std::make_unique<Marks>();
  } else {
    marks_ = std::move(idle.back());
    idle.pop_back();
  }
  if (marks_->lastQuery.size() < triangles) marks_->lastQuery.resize(triangles);
  if (++marks_->queries == 0) {
    std::fill(marks_->lastQuery.begin(), marks_->lastQuery.end(), 0U);
    marks_->queries = 1;
  }
  at_ = marks_->lastQuery.data();
  query_ = marks_->queries;
}

SeenTriangles::~SeenTriangles() {
  idleMarks<Marks>().push_back(std::move(marks_));
}

}  // namespace cairn::bullet
