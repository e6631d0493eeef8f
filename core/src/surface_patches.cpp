// SPDX-License-Identifier: Zlib
#include "cairn/core/surface_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace cairn {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Contacts lean out of the cone of a patch's normals by as much as their own cones open: 0.2 rad, and rounding.
constexpr float kLean = 0.25F;

// Triangles around a patch: room for them at once.
constexpr std::size_t kUsuallyTouched = 256;

constexpr Box kNothing{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

void makeUnique(std::vector<std::uint32_t>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

void Box::add(const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = std::min(lower[axis], p[axis]);
    upper[axis] = std::max(upper[axis], p[axis]);
  }
}

bool Box::holds(const Vec3& p) const {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < lower[axis] || p[axis] > upper[axis]) return false;
  return true;
}

class SurfacePatches::Maker {
 public:
  Maker(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
        const SurfaceFeatures& features, SurfacePatches& out)
      : meshVertices_(vertices), meshTriangles_(triangles), features_(features), out_(out) {
    touched_.reserve(kUsuallyTouched);
    seenBy_.assign(triangles.size(), 0);
  }

  void run() {
    out_.ofVertices_.assign(meshVertices_.size(), SurfaceEdge::kNone);
    out_.ofEdges_.assign(features_.edges().size(), SurfaceEdge::kNone);
    out_.ofTriangles_.assign(meshTriangles_.size(), SurfaceEdge::kNone);
    std::vector<std::uint32_t> triangles(meshTriangles_.size());
    std::iota(triangles.begin(), triangles.end(), 0U);
    out_.box_ = addFamily(triangles).box;
  }

  // Families come after those that hold them.
  void follow() {
    out_.numbers_.clear();
    for (Record& record : out_.records_) place(record);
    for (std::size_t i = out_.families_.size(); i-- > 0;) {
      PatchFamily& family = out_.families_[i];
      for (std::uint32_t lane = 0; lane < PatchFamily::kWidth; ++lane)
        if (family.lower[0][lane] <= family.upper[0][lane]) setLane(family, lane, boundsOf(family, lane));
    }
    out_.box_ = boundsOfAll(out_.families_[0]).box;
  }

 private:
  Vec3 middle(std::uint32_t triangle) const {
    Box box = kNothing;
    for (const std::uint32_t v : meshTriangles_[triangle]) box.add(meshVertices_[v]);
    return box.middle();
  }

  struct Bounds {
    Box box, normals;
  };
  using Triangles = std::span<std::uint32_t>;

  static bool isPatch(Triangles triangles) { return triangles.size() <= SurfacePatch::kMaxTriangles; }

  // Along the longest axis.
  void halve(Triangles triangles) const {
    Box box = kNothing;
    for (const std::uint32_t t : triangles) box.add(middle(t));
    const Vec3 extent = box.upper - box.lower;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::ranges::sort(triangles, {}, [&](std::uint32_t t) { return std::pair(middle(t)[axis], t); });
  }

  // Halved until there are eight parts, or no more than patches.
  std::vector<Triangles> partsOf(Triangles triangles) const {
    std::vector<Triangles> parts{triangles};
    for (int halving = 0; halving < 3; ++halving) {
      std::vector<Triangles> halves;
      for (const Triangles& part : parts) {
        if (isPatch(part)) {
          halves.push_back(part);
          continue;
        }
        halve(part);
        halves.push_back(part.first(part.size() / 2));
        halves.push_back(part.subspan(part.size() / 2));
      }
      parts.swap(halves);
    }
    return parts;
  }

  Bounds addFamily(Triangles triangles) {
    const std::size_t self = out_.families_.size();
    out_.families_.push_back(emptyFamily());
    Bounds all{kNothing, kNothing};
    const std::vector<Triangles> parts = partsOf(triangles);
    for (std::uint32_t lane = 0; lane < parts.size(); ++lane) {
      const bool isLast = isPatch(parts[lane]);
      out_.families_[self].child[lane] = isLast ? out_.count() : static_cast<std::uint32_t>(out_.families_.size());
      const Bounds part = isLast ? addPatch(parts[lane]) : addFamily(parts[lane]);
      PatchFamily& family = out_.families_[self];
      family.patches |= static_cast<std::uint32_t>(isLast) << lane;
      setLane(family, lane, part);
      all = {joined(all.box, part.box), joined(all.normals, part.normals)};
    }
    return all;
  }

  static void setLane(PatchFamily& family, std::uint32_t lane, const Bounds& part) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int k = static_cast<int>(axis);
      family.lower[axis][lane] = part.box.lower[k];
      family.upper[axis][lane] = part.box.upper[k];
      family.normalLower[axis][lane] = part.normals.lower[k];
      family.normalUpper[axis][lane] = part.normals.upper[k];
    }
  }

  Bounds boundsOf(const PatchFamily& family, std::uint32_t lane) const {
    const std::uint32_t child = family.child[lane];
    if (!family.isPatch(lane)) return boundsOfAll(out_.families_[child]);
    return {out_.records_[child].box, out_.records_[child].normals};
  }

  static Bounds boundsOfAll(const PatchFamily& family) {
    Bounds all{kNothing, kNothing};
    for (std::uint32_t lane = 0; lane < PatchFamily::kWidth; ++lane) {
      if (!(family.lower[0][lane] <= family.upper[0][lane])) continue;
      const auto at = [&](const float(&rows)[3][PatchFamily::kWidth]) {
        return Vec3(rows[0][lane], rows[1][lane], rows[2][lane]);
      };
      all = {joined(all.box, family.box(lane)), joined(all.normals, {at(family.normalLower), at(family.normalUpper)})};
    }
    return all;
  }

  static PatchFamily emptyFamily() {
    PatchFamily family{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::ranges::fill(family.lower[axis], kInfinity);
      std::ranges::fill(family.upper[axis], -kInfinity);
    }
    return family;
  }

  static Box joined(Box box, const Box& other) {
    box.add(other.lower);
    box.add(other.upper);
    return box;
  }

  Bounds addPatch(std::span<const std::uint32_t> triangles) {
    std::vector<std::uint32_t> vertices, edges;
    for (const std::uint32_t t : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        vertices.push_back(meshTriangles_[t][k]);
        edges.push_back(features_.edgesOf()[t][k]);
      }
    makeUnique(vertices);
    makeUnique(edges);
    for (const std::uint32_t t : triangles) out_.ofTriangles_[t] = out_.count();
    const auto firstForeign = ownFirst(vertices, out_.ofVertices_);
    edges.erase(ownFirst(edges, out_.ofEdges_), edges.end());
    Record record;
    record.firstIndex = static_cast<std::uint32_t>(out_.indices_.size());
    record.firstEnd = static_cast<std::uint32_t>(out_.ends_.size());
    record.vertices = static_cast<std::uint16_t>(vertices.size());
    record.ownVertices = static_cast<std::uint16_t>(firstForeign - vertices.begin());
    record.edges = static_cast<std::uint16_t>(edges.size());
    record.triangles = static_cast<std::uint16_t>(triangles.size());
    for (const auto& list :
         {std::span<const std::uint32_t>(vertices), std::span<const std::uint32_t>(edges), triangles})
      out_.indices_.insert(out_.indices_.end(), list.begin(), list.end());
    out_.ends_.resize(out_.ends_.size() + edges.size());
    place(record);
    out_.records_.push_back(record);
    return {record.box, record.normals};
  }

  // All of a patch that depends on where its vertices are.
  void place(Record& record) {
    const std::span<std::uint32_t> all(out_.indices_);
    const std::span<const std::uint32_t> vertices = all.subspan(record.firstIndex, record.vertices);
    const std::span<std::uint32_t> edges = all.subspan(record.firstIndex + record.vertices, record.edges);
    const std::span<const std::uint32_t> triangles =
        all.subspan(record.firstIndex + record.vertices + record.edges, record.triangles);
    record.convexEdges = convexFirst(edges);
    record.firstNumber = static_cast<std::uint32_t>(out_.numbers_.size());
    record.box = kNothing;
    for (const std::uint32_t v : vertices) record.box.add(meshVertices_[v]);
    findTrianglesAround(triangles, vertices.first(record.ownVertices), edges);
    const Vec3 mean = facingOf(touched_);
    record.normals = normalsOf(touched_, mean);
    record.facing = isBent(touched_, mean) ? Vec3() : mean;
    record.lowest = kInfinity;
    record.highest = -kInfinity;
    for (const std::uint32_t v : vertices) {
      record.lowest = std::min(record.lowest, dot(record.facing, meshVertices_[v]));
      record.highest = std::max(record.highest, dot(record.facing, meshVertices_[v]));
    }
    listEnds(vertices, edges, std::span(out_.ends_).subspan(record.firstEnd, record.edges));
    addVertices(vertices);
    addFaces(triangles);
    addEdges(edges.first(record.convexEdges));
  }

  // Ascending, the convex ones before the others; returns how many these are.
  std::uint16_t convexFirst(std::span<std::uint32_t> edges) const {
    std::ranges::sort(edges, {}, [&](std::uint32_t e) { return std::pair(!features_.edges()[e].isConvex, e); });
    return static_cast<std::uint16_t>(
        std::ranges::count_if(edges, [&](std::uint32_t e) { return features_.edges()[e].isConvex; }));
  }

  // Moves what no patch owns yet to the front, and gives it to the one at hand.
  std::vector<std::uint32_t>::iterator ownFirst(std::vector<std::uint32_t>& list,
                                                std::vector<std::uint32_t>& owners) const {
    const auto end = std::stable_partition(list.begin(), list.end(),
                                           [&](std::uint32_t i) { return owners[i] == SurfaceEdge::kNone; });
    std::for_each(list.begin(), end, [&](std::uint32_t i) { owners[i] = out_.count(); });
    return end;
  }

  // The patch's, and all others that meet in its own vertices and edges.
  void findTrianglesAround(std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> ownVertices,
                           std::span<const std::uint32_t> ownEdges) {
    touched_.clear();
    ++search_;
    const auto add = [&](std::uint32_t t) {
      if (t == SurfaceEdge::kNone || seenBy_[t] == search_) return;
      seenBy_[t] = search_;
      touched_.push_back(t);
    };
    const auto addOf = [&](std::uint32_t edge) { std::ranges::for_each(features_.edges()[edge].triangle, add); };
    std::ranges::for_each(triangles, add);
    for (const std::uint32_t v : ownVertices) std::ranges::for_each(features_.edgesAround(v), addOf);
    std::ranges::for_each(ownEdges, addOf);
    std::ranges::sort(touched_);
  }

  Vec3 facingOf(std::span<const std::uint32_t> triangles) const {
    Vec3 sum;
    for (const std::uint32_t t : triangles) sum += features_.faces()[t].normal;
    const float norm = length(sum);
    return norm > 0 ? sum / norm : Vec3();
  }

  // Whether what a contact's normal may be here is not on one side.
  bool isBent(std::span<const std::uint32_t> triangles, const Vec3& mean) const {
    return std::ranges::any_of(triangles,
                               [&](std::uint32_t t) { return dot(features_.faces()[t].normal, mean) < kLean; });
  }

  // Of unit vectors within `angle` of `mean`, each coordinate lies within that of the axis's own angle to it. In
  // doubles, whose last bit is the C library's own affair: rounded to float afterwards, it hardly ever shows.
  Box normalsOf(std::span<const std::uint32_t> triangles, const Vec3& mean) const {
    Box box{{-1, -1, -1}, {1, 1, 1}};
    if (mean == Vec3()) return box;
    const auto angleOf = [](float cosine) { return std::acos(double(std::clamp(cosine, -1.0F, 1.0F))); };
    float least = 1;
    for (const std::uint32_t t : triangles) {
      const Vec3& normal = features_.faces()[t].normal;
      if (normal != Vec3()) least = std::min(least, dot(normal, mean));
    }
    const double angle = angleOf(least);
    for (int axis = 0; axis < 3; ++axis) {
      const double own = angleOf(mean[axis]);
      box.lower[axis] = static_cast<float>(std::cos(std::min(own + angle + double(kLean), std::numbers::pi)));
      box.upper[axis] = static_cast<float>(std::cos(std::max(own - angle - double(kLean), 0.0)));
    }
    return box;
  }

  void listEnds(std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> edges,
                std::span<std::array<std::uint8_t, 2>> ends) const {
    const auto place = [&](std::uint32_t v) {
      return static_cast<std::uint8_t>(std::ranges::find(vertices, v) - vertices.begin());
    };
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const SurfaceEdge& edge = features_.edges()[edges[i]];
      ends[i] = {place(edge.vertex[0]), place(edge.vertex[1])};
    }
  }

  // `numberOf(i, column)` of the i-th of `count` things, or of one that pads.
  template <class NumberOf>
  void addColumns(std::size_t count, int columns, const NumberOf& numberOf) {
    for (int column = 0; column < columns; ++column)
      for (std::size_t i = 0; i < SurfacePatch::padded(count); ++i) out_.numbers_.push_back(numberOf(i, column));
  }

  void addVertices(std::span<const std::uint32_t> vertices) {
    addColumns(vertices.size(), 3, [&](std::size_t i, int column) {
      return meshVertices_[vertices[std::min(i, vertices.size() - 1)]][column];
    });
  }

  // Padding lies at minus infinity, below every range of heights.
  void addFaces(std::span<const std::uint32_t> triangles) {
    addColumns(triangles.size(), 16, [&](std::size_t i, int column) {
      const SurfaceFace* const face = i < triangles.size() ? &features_.faces()[triangles[i]] : nullptr;
      if (!face || face->normal == Vec3()) return column == 3 ? kInfinity : 0.0F;
      if (column < 4) return column < 3 ? face->normal[column] : face->offset;
      const auto side = static_cast<std::size_t>(column / 4 - 1);
      return column % 4 < 3 ? face->inward[side][column % 4] : face->inwardOffset[side];
    });
  }

  void addEdges(std::span<const std::uint32_t> edges) {
    addColumns(edges.size(), 9, [&](std::size_t i, int column) {
      if (i >= edges.size()) return 0.0F;
      const SurfaceEdge& edge = features_.edges()[edges[i]];
      if (column >= 6) return edge.outward[column - 6];
      return meshVertices_[edge.vertex[static_cast<std::size_t>(column / 3)]][column % 3];
    });
  }

  std::span<const Vec3> meshVertices_;
  std::span<const std::array<std::uint32_t, 3>> meshTriangles_;
  const SurfaceFeatures& features_;
  SurfacePatches& out_;
  std::vector<std::uint32_t> touched_;
  std::vector<std::uint32_t> seenBy_;  // of each triangle, the last search that found it
  std::uint32_t search_ = 0;
};

SurfacePatches::SurfacePatches(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
                               const SurfaceFeatures& features) {
  Maker(vertices, triangles, features, *this).run();
}

void SurfacePatches::follow(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
                            const SurfaceFeatures& features) {
  Maker(vertices, triangles, features, *this).follow();
}

std::size_t SurfacePatches::memoryBytes() const {
  return families_.capacity() * sizeof(PatchFamily) + records_.capacity() * sizeof(Record) +
         indices_.capacity() * sizeof(std::uint32_t) + ends_.capacity() * sizeof(ends_[0]) +
         numbers_.capacity() * sizeof(float) +
         (ofVertices_.capacity() + ofEdges_.capacity() + ofTriangles_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace cairn
