// SPDX-License-Identifier: Zlib
#include "cairn/bullet/terrain_shape.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <LinearMath/btAabbUtil2.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "cairn/core/log.h"
#include "placement/bullet_math.h"
#include "terrain/terrain_cast.h"
#include "terrain/terrain_lattice.h"

namespace cairn::bullet {

namespace {

constexpr char kTerrainName[] = "CairnTerrain";  // where it is tells the class, as with trees
constexpr std::uint32_t kMaxPoints = 1U << 20;   // points a side
constexpr std::uint64_t kMaxCells = 1ULL << 30;
// Least cell size in units in the last place of the farthest coordinate. Then neighbouring cells differ in width by at
// most an eighth.
constexpr double kMinUnits = 16;

Status checkSides(const TerrainGrid& grid) {
  const std::string sides = std::to_string(grid.columns) + " x " + std::to_string(grid.rows) + " points";
  if (grid.columns < 2 || grid.rows < 2)
    return Error{"a terrain of " + sides + " has no cells: give at least 2 x 2 points"};
  const std::uint64_t cells = std::uint64_t(grid.columns - 1) * (grid.rows - 1);
  if (grid.columns > kMaxPoints || grid.rows > kMaxPoints || cells > kMaxCells)
    return Error{"a terrain of " + sides + " is too large: divide it into several of at most 2^20 points a side and " +
                 "2^30 cells"};
  if (grid.heights.size() != std::uint64_t(grid.columns) * grid.rows)
    return Error{"a terrain of " + sides + " was given " + std::to_string(grid.heights.size()) +
                 " heights: give one for each point"};
  return {};
}

Status checkCell(const TerrainGrid& grid) {
  if (!(grid.cell > 0) || !std::isfinite(grid.cell))
    return Error{"a terrain cannot have cells of " + std::to_string(grid.cell) + " m: give a positive, finite size"};
  const double farthest = 0.5 * grid.cell * std::max(grid.columns, grid.rows);
  if (!std::isfinite(static_cast<btScalar>(farthest)) || grid.cell < kMinUnits * double(SIMD_EPSILON) * farthest ||
      static_cast<btScalar>(grid.cell) < std::numeric_limits<btScalar>::min())
    return Error{"a terrain's cells of " + std::to_string(grid.cell) + " m cannot be told apart " +
                 std::to_string(farthest) + " m from its middle: give fewer or larger ones"};
  if (!isFinite(grid.origin)) return Error{"a terrain's origin is not finite: give finite coordinates"};
  return {};
}

Status checkHeights(const TerrainGrid& grid) {
  for (std::size_t i = 0; i < grid.heights.size(); ++i)
    if (std::isinf(grid.heights[i]))
      return Error{"a terrain's height at column " + std::to_string(i % grid.columns) + ", row " +
                   std::to_string(i / grid.columns) + " is infinite: give a finite one, or NaN for none"};
  return {};
}

}  // namespace

Result<std::unique_ptr<TerrainShape>> TerrainShape::create(TerrainGrid grid) {
  for (const auto& check : {checkSides, checkCell, checkHeights})
    if (Status status = check(grid); !status) return status.error();
  std::unique_ptr<TerrainShape> shape(new TerrainShape(std::move(grid)));
  if (shape->lower_.z() > shape->upper_.z())
    return Error{"a terrain has no triangle: three neighbouring points with heights are needed"};
  return shape;
}

TerrainShape::TerrainShape(TerrainGrid grid) : lattice_(std::make_unique<const TerrainLattice>(std::move(grid))) {
  m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  const TerrainGrid& own = lattice_->grid();
  origin_ = own.origin + Vec3d(own.columns - 1, own.rows - 1, 0) * (0.5 * own.cell);
  const HeightBounds bounds = lattice_->bounds();
  lower_.setValue(lattice_->xs().front(), lattice_->ys().front(), btScalar(bounds.lower));
  upper_.setValue(lattice_->xs().back(), lattice_->ys().back(), btScalar(bounds.upper));
}

TerrainShape::~TerrainShape() = default;

const TerrainGrid& TerrainShape::grid() const {
  return lattice_->grid();
}

std::size_t TerrainShape::memoryBytes() const {
  return sizeof *this + lattice_->memoryBytes();
}

std::optional<double> TerrainShape::heightAt(double x, double y) const {
  const double height = lattice_->heightOver(x, y);
  return std::isnan(height) ? std::nullopt : std::optional(height);
}

std::optional<btVector3> TerrainShape::normalAt(double x, double y) const {
  TerrainLattice::Corners t;
  if (!lattice_->cornersOver(x, y, t)) return std::nullopt;
  const Vec3d normal = t.normal();
  return toBullet(normal / length(normal));
}

void TerrainShape::processAllTriangles(btTriangleCallback* callback, const btVector3& aabbMin,
                                       const btVector3& aabbMax) const {
  if (answerCast(*lattice_, *callback)) return;
  lattice_->forEachCell(aabbMin, aabbMax, [&](std::int64_t column, std::int64_t row) {
    for (const bool isUpper : {false, true}) {
      TerrainLattice::Corners t;
      if (!lattice_->corners(column, row, isUpper, t)) continue;
      if (TestTriangleAgainstAabb2(t.at, aabbMin, aabbMax))
        callback->processTriangle(t.at, 0, lattice_->indexOf(column, row, isUpper));
    }
  });
}

void TerrainShape::getAabb(const btTransform& t, btVector3& aabbMin, btVector3& aabbMax) const {
  btTransformAabb(lower_, upper_, getMargin(), t, aabbMin, aabbMax);
}

void TerrainShape::calculateLocalInertia(btScalar /*mass*/, btVector3& inertia) const {
  inertia.setValue(0, 0, 0);
}

void TerrainShape::setLocalScaling(const btVector3& scaling) {
  if (scaling == btVector3(1, 1, 1)) return;
  char message[160];
  std::snprintf(message, sizeof(message),
                "a terrain cannot be scaled by (%g, %g, %g): scale the cell and the heights of its grid",
                double(scaling.x()), double(scaling.y()), double(scaling.z()));
  logMessage(message);
}

// Writes no chunk, because importers count chunks that they cannot read.
void TerrainShape::serializeSingleShape(btSerializer* /*serializer*/) const {
  logMessage("a terrain's heights are not written to .bullet files: make it again from its grid");
}

const char* TerrainShape::getName() const {
  return kTerrainName;
}

const TerrainShape* asTerrain(const btCollisionShape* shape) {
  if (shape->getShapeType() != FAST_CONCAVE_MESH_PROXYTYPE || shape->getName() != kTerrainName) return nullptr;
  return static_cast<const TerrainShape*>(shape);
}

}  // namespace cairn::bullet
