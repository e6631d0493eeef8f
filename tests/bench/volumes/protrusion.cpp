// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/protrusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace cairn::bench {
namespace {

using builder::CertifiedProtrusion;
using builder::ProtrusionTolerance;
using builder::SignedDistance;

/// Points of the core between two bounds along each axis, plus directions between three unit vectors times [inner,
/// outer].
struct Cell {
  std::array<double, 3> lower{}, upper{};  ///< along the core's axes
  std::array<Vec3d, 3> directions;
  double inner = 0, outer = 0;
  double bound = 0;              ///< proved: no point of the cell is farther from the solid
  std::uint32_t face = 0;        ///< a triangle of the face that proved it
  double coreDepth = 0;          ///< no point of the core's part is less deep
  std::array<double, 4> gain{};  ///< how unequal the bound is along the core's axes and among directions

  friend bool operator<(const Cell& a, const Cell& b) { return a.bound < b.bound; }
};

// Of what is between bound and witness: smaller inequalities do not decide where a cell is cut. 0.2 costs the same.
constexpr double kGainShare = 0.5;
// Of a cell's greatest width: thinner ones are not cut for their bound. A tenth or nine tenths cost a quarter more, a
// fiftieth thrice as much (the box around a chair).
constexpr double kLeastAspect = 0.3;
// Up to this many triangles all of them are looked at for each part of the core.
constexpr std::size_t kFewTriangles = 256;
// Of a part of the core, at either end.
constexpr double kShrink = 1e-6;

template <class Points>
std::pair<double, double> extentOf(const Points& points, const Vec3d& along) {
  std::pair<double, double> extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec3d& p : points) {
    extent.first = std::min(extent.first, dot(p, along));
    extent.second = std::max(extent.second, dot(p, along));
  }
  return extent;
}

enum class Cut : std::uint8_t { alongFirst, alongSecond, alongThird, directions, radius };

class VolumeSearch {
 public:
  VolumeSearch(const SignedDistance& solid, const FlatFaces& faces, const SweptBall& volume,
               const ProtrusionTolerance& tolerance)
      : solid_(solid), faces_(faces), volume_(volume), tolerance_(tolerance) {}

  CertifiedProtrusion run() {
    const SignedDistance::Answer atCenter = solid_.query(volume_.center);
    result_.depth = atCenter.depth;
    result_.witness = volume_.center;
    best_ = std::max(0.0, -atCenter.depth);
    const double whole = volume_.reach() - atCenter.depth;
    double upper = std::max(0.0, whole);
    if (!closeEnough(upper)) upper = refine(whole, atCenter.nearest.triangle);
    const Vec3d far{volume_.reach(), volume_.reach(), volume_.reach()};
    const double guard = 2 * solid_.roundingBound(volume_.center + far);
    result_.upper = whole + guard <= 0 ? 0 : upper + guard;
    result_.lower = std::max(0.0, best_ - guard);
    return result_;
  }

 private:
  bool closeEnough(double upper) const {
    return upper <= best_ * (1 + tolerance_.relative) + tolerance_.absolute || best_ > tolerance_.ofInterest;
  }

  /// Good first witnesses lie off the core's ends and middles, along the axes and away from the surface nearest to
  /// them.
  void offerFarPoints(std::uint32_t triangle) {
    Cell near;
    near.face = triangle;
    for (int i = 0; i < 27; ++i) {
      const std::array<int, 3> at{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
      std::array<double, 3> along{};
      bool isMet = false;  // before, where the core has no extent
      for (std::size_t axis = 0; axis < 3; ++axis) {
        along[axis] = at[axis] * volume_.half[axis];
        isMet |= at[axis] != 0 && !(volume_.half[axis] > 0);
      }
      if (isMet) continue;
      const Vec3d core = volume_.onCore(along);
      for (const Vec3d& axis : volume_.axes)
        for (const double side : {-volume_.radius, volume_.radius}) (void)ask(core + axis * side, near);
      const SignedDistance::Answer atCore = ask(core, near);
      const Vec3d away = atCore.depth > 0 ? atCore.nearest.point - core : core - atCore.nearest.point;
      if (lengthSq(away) > 0) (void)ask(core + normalized(away) * volume_.radius, near);
    }
  }

  double refine(double whole, std::uint32_t triangle) {
    offerFarPoints(triangle);
    for (int octant = 0; octant < 8; ++octant) {
      const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1, z = octant & 4 ? -1 : 1;
      Cell cell;
      cell.lower = {-volume_.half[0], -volume_.half[1], -volume_.half[2]};
      cell.upper = volume_.half;
      cell.directions = {volume_.axes[0] * x, volume_.axes[1] * y, volume_.axes[2] * z};
      cell.outer = volume_.radius;
      cell.bound = whole;
      cell.face = triangle;
      measureCore(cell);
      boundCell(cell);
      keep(cell);
    }
    while (!cells_.empty() && !closeEnough(cells_.front().bound) && queries_ < tolerance_.maxQueries) {
      std::pop_heap(cells_.begin(), cells_.end());
      const Cell cell = cells_.back();
      cells_.pop_back();
      split(cell);
    }
    return std::max(best_, cells_.empty() ? 0.0 : cells_.front().bound);
  }

  void split(const Cell& cell) {
    for (Cell& part : partsOf(cell, cutOf(cell))) {
      boundCell(part);
      keep(part);
    }
  }

  /// Along which the bound is most unequal or, where that says little, along which the cell is widest.
  Cut cutOf(const Cell& cell) const {
    const auto& [a, b, c] = cell.directions;
    const double across = std::sqrt(std::max({lengthSq(a - b), lengthSq(b - c), lengthSq(c - a)}));
    const std::array<double, 5> width{cell.upper[0] - cell.lower[0], cell.upper[1] - cell.lower[1],
                                      cell.upper[2] - cell.lower[2], across * cell.outer, cell.outer - cell.inner};
    const auto most =
        static_cast<std::size_t>(std::max_element(cell.gain.begin(), cell.gain.end()) - cell.gain.begin());
    const auto widest = static_cast<std::size_t>(std::max_element(width.begin(), width.end()) - width.begin());
    const bool isUnequal = cell.gain[most] > kGainShare * (cell.bound - best_);
    return static_cast<Cut>(isUnequal && width[most] > kLeastAspect * width[widest] ? most : widest);
  }

  void keep(const Cell& cell) {
    if (cell.bound <= best_) return;
    cells_.push_back(cell);
    std::push_heap(cells_.begin(), cells_.end());
  }

  /// None where the cell has no extent to be cut.
  std::vector<Cell> partsOf(const Cell& cell, Cut cut) {
    std::vector<Cell> parts;
    if (cut == Cut::directions) {
      const auto& [a, b, c] = cell.directions;
      const Vec3d ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
      parts.assign(4, cell);
      parts[0].directions = {ab, bc, ca};
      parts[1].directions = {a, ab, ca};
      parts[2].directions = {b, bc, ab};
      parts[3].directions = {c, ca, bc};
    } else if (cut == Cut::radius) {
      if (!(cell.outer > cell.inner)) return parts;
      parts.assign(2, cell);
      parts[0].outer = parts[1].inner = (cell.inner + cell.outer) / 2;
    } else {
      const auto axis = static_cast<std::size_t>(cut);
      if (!(cell.upper[axis] > cell.lower[axis])) return parts;
      parts.assign(2, cell);
      parts[0].upper[axis] = parts[1].lower[axis] = (cell.lower[axis] + cell.upper[axis]) / 2;
      for (Cell& part : parts) measureCore(part);
    }
    return parts;
  }

  Vec3d middleOfCore(const Cell& cell) const {
    std::array<double, 3> middle;
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = (cell.lower[axis] + cell.upper[axis]) / 2;
    return volume_.onCore(middle);
  }
  Vec3d cornerOfCore(const Cell& cell, std::size_t corner) const {
    std::array<double, 3> at;
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = corner >> axis & 1 ? cell.upper[axis] : cell.lower[axis];
    return volume_.onCore(at);
  }
  /// Whether it is another corner than those of lower numbers.
  bool hasCorner(std::size_t corner) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((corner >> axis & 1) != 0 && !(volume_.half[axis] > 0)) return false;
    return true;
  }
  /// Bounds the depth of the core's part from below: by the depth of its middle (1-Lipschitz) or, for a part inside, by
  /// its distance from each triangle. The latter does not mind how long the part is.
  void measureCore(Cell& cell) {
    const double half =
        std::hypot(cell.upper[0] - cell.lower[0], cell.upper[1] - cell.lower[1], cell.upper[2] - cell.lower[2]) / 2;
    const double depth = ask(middleOfCore(cell), cell).depth;
    cell.coreDepth = depth - half;
    if (depth > 0 && solid_.mesh().triangles.size() <= kFewTriangles) {
      const double apart = apartFromSurface(cell);
      if (apart > 0) cell.coreDepth = std::max(cell.coreDepth, apart - kShrink * half);
    }
    cell.bound = std::min(cell.bound, cell.outer - cell.coreDepth);
  }
  /// No triangle is nearer to the core's part, shrunk a little so that one may lie flush; negative where it is not
  /// sure.
  double apartFromSurface(const Cell& cell) const {
    const Vec3d middle = middleOfCore(cell);
    std::array<Vec3d, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) corners[i] = middle + (cornerOfCore(cell, i) - middle) * (1 - kShrink);
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < solid_.mesh().triangles.size() && least > 0; ++t)
      least = std::min(least, separation(corners, solid_.mesh().corners(t)));
    return least;
  }
  /// The widest gap along the triangle's normal or one of the volume's axes: at most the distance.
  double separation(const std::array<Vec3d, 8>& core, const std::array<Vec3d, 3>& triangle) const {
    double widest = -std::numeric_limits<double>::infinity();
    for (const Vec3d& along : {normalized(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])), volume_.axes[0],
                               volume_.axes[1], volume_.axes[2]}) {
      const auto [low, high] = extentOf(core, along);
      const auto [lower, upper] = extentOf(triangle, along);
      widest = std::max({widest, lower - high, low - upper});
    }
    return widest;
  }

  SignedDistance::Answer ask(const Vec3d& point, const Cell& cell) {
    const SignedDistance::Answer answer = solid_.query(point, solid_.distanceToTriangle(cell.face, point));
    ++queries_;
    if (-answer.depth > best_) {
      best_ = -answer.depth;
      result_.witness = point;
    }
    return answer;
  }

  /// Lowers the bound of a cell, by two queries at most.
  void boundCell(Cell& cell) {
    // Points this near to the core are no farther from the solid than the witness: dist(x) <= |x - y| - s(y).
    cell.inner = std::max(cell.inner, best_ + cell.coreDepth);
    if (cell.inner > cell.outer) cell.bound = 0;
    if (cell.bound <= best_) return;
    const auto& [a, b, c] = cell.directions;
    const Vec3d point = middleOfCore(cell) + normalized(a + b + c) * cell.outer;
    const SignedDistance::Answer answer = ask(point, cell);
    Vec3d worst = point;
    const std::uint32_t inherited = cell.face;
    tighten(cell, answer.nearest.triangle, point, answer.depth, worst);
    if (inherited != answer.nearest.triangle) tighten(cell, inherited, point, answer.depth, worst);
    if (cell.bound > best_) ask(worst, cell);
  }

  /// A convex function of the point, up to the faces' guard; never less than the distance to the solid.
  double distanceToFace(std::uint32_t triangle, const Vec3d& point) const {
    double nearest = solid_.distanceToTriangle(triangle, point);
    for (const std::uint32_t other : faces_.around(triangle))
      if (other != triangle) nearest = std::min(nearest, solid_.distanceToTriangle(other, point));
    return nearest;
  }

  /// Lowers the bound by the hull's corners: their distance from one face, and from the point that was asked for
  /// (the 1-Lipschitz bound). If the face serves, it becomes the cell's, and `worst` the point of the volume at the
  /// corner farthest from it.
  void tighten(Cell& cell, std::uint32_t face, const Vec3d& point, double depth, Vec3d& worst) const {
    const auto& [a, b, c] = cell.directions;
    // As in `certifiedProtrusion`: directions between a, b, c reach 1 / cosine of the plane through them.
    const double outer = cell.outer / std::abs(dot(a, normalized(cross(b - a, c - a))));
    double toFace = 0, toPointSq = 0;
    Vec3d farthest = point;
    std::array<double, 8> most{};       // by the core's corner
    std::array<double, 3> mostAmong{};  // by direction
    for (std::size_t i = 0; i < 8; ++i) {
      if (!hasCorner(i)) continue;
      const Vec3d core = cornerOfCore(cell, i);
      for (std::size_t k = 0; k < 3; ++k)
        for (const bool isOuter : {false, true}) {
          const Vec3d corner = core + cell.directions[k] * (isOuter ? outer : cell.inner);
          toPointSq = std::max(toPointSq, lengthSq(corner - point));
          const double far = distanceToFace(face, corner);
          most[i] = std::max(most[i], far);
          mostAmong[k] = std::max(mostAmong[k], far);
          if (far <= toFace) continue;
          toFace = far;
          farthest = core + cell.directions[k] * (isOuter ? cell.outer : cell.inner);
        }
    }
    cell.bound = std::min(cell.bound, std::sqrt(toPointSq) - depth);
    if (toFace + faces_.guard() > cell.bound) return;
    cell.bound = toFace + faces_.guard();
    cell.face = face;
    worst = farthest;
    cell.gain = {};
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (hasCorner(i) && (i >> axis & 1) != 0)
          cell.gain[axis] = std::max(cell.gain[axis], std::abs(most[i] - most[i ^ (std::size_t{1} << axis)]));
    const auto [least, greatest] = std::minmax_element(mostAmong.begin(), mostAmong.end());
    cell.gain[3] = std::max(*greatest - *least, outer - cell.outer);
  }

  const SignedDistance& solid_;
  const FlatFaces& faces_;
  const SweptBall& volume_;
  ProtrusionTolerance tolerance_;
  double best_ = 0;
  std::uint32_t queries_ = 0;
  std::vector<Cell> cells_;
  CertifiedProtrusion result_;
};

}  // namespace

CertifiedProtrusion volumeProtrusion(const SignedDistance& solid, const FlatFaces& faces, const SweptBall& volume,
                                     const ProtrusionTolerance& tolerance) {
  return VolumeSearch(solid, faces, volume, tolerance).run();
}

}  // namespace cairn::bench
