// SPDX-License-Identifier: Zlib
#include "terrain/terrain_cast.h"

#include <algorithm>

#include "placement/bullet_math.h"
#include "queries/bullet_casts.h"
#include "queries/convex_caster.h"
#include "queries/query_frame.h"
#include "terrain/swept_path.h"
#include "terrain/terrain_lattice.h"

namespace cairn::bullet {

namespace {

// Bullet reports a hit for a ray that misses a triangle by up to 1e-4 in each barycentric coordinate. This moves a
// point by at most twice that times the triangle's extent along an axis.
constexpr double kEdgeTolerance = 2e-4;

double roundingSlack(const TerrainLattice& lattice, double farthest) {
  const double reach = std::max(double(lattice.xs().back()), double(lattice.ys().back()));
  return kQueryRoundings * double(SIMD_EPSILON) * (farthest + reach);
}

// Walks along a path over blocks and then their cells, row by row, in the order of the path. In a row all cells are
// visited before the next row, so the order is exact but for the path's own width.
template <class End, class Ask>
class CellWalk {
 public:
  // `end()`: the fraction beyond which nothing is wanted. `ask(column, row)` is called for each cell that the path can
  // meet.
  CellWalk(const TerrainLattice& lattice, const SweptPath& path, const End& end, const Ask& ask)
      : lattice_(lattice), path_(path), end_(end), ask_(ask) {}

  void go() const {
    const IndexRange columns{0, (lattice_.cellColumns() - 1) / TerrainLattice::kBlock};
    const IndexRange rows{0, (lattice_.cellRows() - 1) / TerrainLattice::kBlock};
    walk(PathPart{}, columns, rows, TerrainLattice::kBlock, [&](std::int64_t i, std::int64_t j, const PathPart& part) {
      if (passes(lattice_.blockBounds(i, j), part)) walkBlock(i, j, part);
    });
  }

 private:
  void walkBlock(std::int64_t i, std::int64_t j, const PathPart& part) const {
    constexpr std::int64_t kBlock = TerrainLattice::kBlock;
    const IndexRange columns = IndexRange{i * kBlock, (i + 1) * kBlock - 1}.cutTo({0, lattice_.cellColumns() - 1});
    const IndexRange rows = IndexRange{j * kBlock, (j + 1) * kBlock - 1}.cutTo({0, lattice_.cellRows() - 1});
    walk(part, columns, rows, 1, [&](std::int64_t column, std::int64_t row, const PathPart& inCell) {
      if (passes(lattice_.cellBounds(column, row), inCell)) ask_(column, row);
    });
  }

  // Squares of `size` cells a side, numbered by columns and rows of squares.
  template <class Visit>
  void walk(const PathPart& part, const IndexRange& columns, const IndexRange& rows, std::int64_t size,
            const Visit& visit) const {
    const IndexRange metRows = rows.cutTo(squares(1, part, size));
    forEach(metRows, path_.path.y < 0, [&](std::int64_t row) {
      const PathPart inRow = during(1, row, size, part);
      if (inRow.isEmpty()) return;
      forEach(columns.cutTo(squares(0, inRow, size)), path_.path.x < 0, [&](std::int64_t column) {
        const PathPart inSquare = during(0, column, size, inRow);
        if (!inSquare.isEmpty()) visit(column, row, inSquare);
      });
    });
  }

  template <class Visit>
  static void forEach(const IndexRange& range, bool isBackwards, const Visit& visit) {
    if (isBackwards)
      for (std::int64_t i = range.last; i >= range.first; --i) visit(i);
    else
      for (std::int64_t i = range.first; i <= range.last; ++i) visit(i);
  }

  // The columns (axis 0) or rows (axis 1) of squares that a part of the path meets.
  IndexRange squares(int axis, const PathPart& part, std::int64_t size) const {
    const double slack = double(SIMD_EPSILON) * (std::abs(path_.from[axis]) + std::abs(path_.path[axis]));
    const auto from = btScalar(path_.least(axis, part) - slack), to = btScalar(path_.greatest(axis, part) + slack);
    const IndexRange cells = axis == 0 ? lattice_.columnsTouching(from, to) : lattice_.rowsTouching(from, to);
    return cells.isEmpty() ? cells : IndexRange{cells.first / size, cells.last / size};
  }
  PathPart during(int axis, std::int64_t square, std::int64_t size, const PathPart& part) const {
    const std::span<const btScalar> points = axis == 0 ? lattice_.xs() : lattice_.ys();
    const auto first = static_cast<std::size_t>(square * size);
    const std::size_t last = std::min(first + static_cast<std::size_t>(size), points.size() - 1);
    return path_.within(axis, double(points[first]), double(points[last]))
        .cutTo({part.from, std::min(part.to, end_())});
  }
  bool passes(const HeightBounds& bounds, const PathPart& part) const {
    const double slack = kEdgeTolerance * (double(bounds.upper) - double(bounds.lower));
    return path_.least(2, part) <= double(bounds.upper) + slack &&
           path_.greatest(2, part) >= double(bounds.lower) - slack;
  }

  const TerrainLattice& lattice_;
  const SweptPath& path_;
  const End& end_;
  const Ask& ask_;
};

void castAlong(const TerrainLattice& lattice, const SweptPath& path, btTriangleCallback& callback, const auto& end) {
  const auto ask = [&](std::int64_t column, std::int64_t row) {
    for (const bool isUpper : {false, true}) {
      TerrainLattice::Corners t;
      if (lattice.corners(column, row, isUpper, t))
        callback.processTriangle(t.at, 0, lattice.indexOf(column, row, isUpper));
    }
  };
  if (!isFinite(path.from) || !isFinite(path.path) || !isFinite(path.half)) return;
  CellWalk(lattice, path, end, ask).go();
}

void castRay(const TerrainLattice& lattice, btTriangleRaycastCallback& ray) {
  const double farthest = double(std::max(ray.m_from.length(), ray.m_to.length()));
  const double slack = roundingSlack(lattice, farthest), beside = slack + kEdgeTolerance * lattice.grid().cell;
  const SweptPath path{toVec3d(ray.m_from), toVec3d(ray.m_to) - toVec3d(ray.m_from), {beside, beside, slack}};
  // The hit fraction is rounded as well.
  castAlong(lattice, path, ray, [&] { return double(ray.m_hitFraction) * (1 + 8 * double(SIMD_EPSILON)); });
}

void castConvex(const TerrainLattice& lattice, btTriangleConvexcastCallback& callback) {
  const btTransform& world = callback.m_triangleToWorld;
  const Mover mover = moverOf(callback, world);
  const btVector3 from = world.invXform(callback.m_convexShapeFrom.getOrigin()) + mover.center;
  const btVector3 to = world.invXform(callback.m_convexShapeTo.getOrigin()) + mover.center;
  const double farthest = double(std::max({from.length(), to.length(), callback.m_convexShapeFrom.getOrigin().length(),
                                           callback.m_convexShapeTo.getOrigin().length(), world.getOrigin().length()}));
  const double slack = roundingSlack(lattice, farthest);
  const SweptPath path{toVec3d(from), toVec3d(to) - toVec3d(from),
                       toVec3d(mover.halfExtent) + Vec3d(slack, slack, slack)};
  ConvexCaster caster(callback);
  castAlong(lattice, path, caster, [&] { return double(caster.m_hitFraction); });
}

}  // namespace

bool answerCast(const TerrainLattice& lattice, btTriangleCallback& callback) {
  if (auto* const ray = asRay(callback)) {
    castRay(lattice, *ray);
    return true;
  }
  auto* const sweep = asSweep(callback);
  if (sweep) castConvex(lattice, *sweep);
  return sweep != nullptr;
}

}  // namespace cairn::bullet
