// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/slivers.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "fracture/renumbered.h"
#include "import/weld.h"

namespace cairn::builder {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // directed, as its triangle goes around

class Turning {
 public:
  explicit Turning(TriangleMesh& mesh) : mesh_(mesh) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) enter(t);
  }

  // One pass; false when no edge was flipped.
  bool pass() {
    bool turned = false;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (isDegenerate(mesh_.corners(t))) turned = turn(t) || turned;
    return turned;
  }

 private:
  void enter(std::uint32_t t) {
    const Triangle& c = mesh_.triangles[t];
    for (int i = 0; i < 3; ++i) owner_[{c[i], c[(i + 1) % 3]}] = t;
  }
  void strike(std::uint32_t t) {
    const Triangle& c = mesh_.triangles[t];
    for (int i = 0; i < 3; ++i) owner_.erase({c[i], c[(i + 1) % 3]});
  }

  // The corner opposite to the longest edge.
  int apexOf(std::uint32_t t) const {
    const auto corners = mesh_.corners(t);
    const auto opposite = [&](int i) { return lengthSq(corners[(i + 2) % 3] - corners[(i + 1) % 3]); };
    int apex = 0;
    for (int i = 1; i < 3; ++i)
      if (opposite(i) > opposite(apex)) apex = i;
    return apex;
  }

  bool turn(std::uint32_t t) {
    const int apex = apexOf(t);
    const Triangle own = mesh_.triangles[t];
    const std::uint32_t m = own[apex], p = own[(apex + 1) % 3], q = own[(apex + 2) % 3];
    const auto across = owner_.find({q, p});
    if (across == owner_.end()) return false;
    const std::uint32_t other = across->second;
    const Triangle& theirs = mesh_.triangles[other];
    const std::uint32_t d = *std::ranges::find_if(theirs, [&](std::uint32_t v) { return v != p && v != q; });
    if (d == m || owner_.contains({m, d}) || owner_.contains({d, m})) return false;
    strike(t);
    strike(other);
    mesh_.triangles[t] = {m, p, d};
    mesh_.triangles[other] = {m, d, q};
    enter(t);
    enter(other);
    return true;
  }

  TriangleMesh& mesh_;
  std::map<Edge, std::uint32_t> owner_;
};

// The vertex that each one becomes: the first of those connected to it by short edges.
std::vector<std::uint32_t> joinedNames(const TriangleMesh& mesh, double tolerance) {
  std::vector<std::uint32_t> name(mesh.vertices.size());
  std::iota(name.begin(), name.end(), 0U);
  const auto first = [&](std::uint32_t v) {
    while (name[v] != v) v = name[v] = name[name[v]];
    return v;
  };
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = first(t[i]), b = first(t[(i + 1) % 3]);
      if (a != b && lengthSq(mesh.vertices[t[i]] - mesh.vertices[t[(i + 1) % 3]]) <= tolerance * tolerance)
        name[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t v = 0; v < name.size(); ++v) name[v] = first(v);
  return name;
}

TriangleMesh joined(const TriangleMesh& mesh, double tolerance) {
  const std::vector<std::uint32_t> name = joinedNames(mesh, tolerance);
  TriangleMesh result{mesh.vertices, {}, {}, {}};
  for (const Triangle& t : mesh.triangles) {
    const Triangle named{name[t[0]], name[t[1]], name[t[2]]};
    if (named[0] != named[1] && named[1] != named[2] && named[2] != named[0]) result.triangles.push_back(named);
  }
  return renumbered(result);
}

void turnCaps(TriangleMesh& mesh) {
  // Each of a row of caps on one long edge passes it on to the next.
  constexpr int kPasses = 16;
  Turning turning(mesh);
  for (int pass = 0; pass < kPasses && turning.pass(); ++pass) {
  }
}

}  // namespace

TriangleMesh withoutSlivers(const TriangleMesh& mesh, double tolerance) {
  TriangleMesh result = joined(mesh, tolerance);
  turnCaps(result);
  return result;
}

}  // namespace cairn::builder
