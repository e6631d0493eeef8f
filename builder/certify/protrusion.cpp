// SPDX-License-Identifier: GPL-3.0-or-later
#include "certify/protrusion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

namespace cairn::builder {
namespace {

/// The directions between three unit vectors, times the radii [inner, outer], from the ball's centre.
struct Piece {
  std::array<Vec3d, 3> directions;
  double inner = 0, outer = 0;
  double upper = 0;            ///< proved: no point of the piece is farther from the solid
  std::uint32_t triangle = 0;  ///< the triangle nearest to a point of the parent piece

  /// Orders a heap with the largest bound on top. The order of ties does not affect the result's validity. The heap's
  /// order is a function of the input alone.
  friend bool operator<(const Piece& a, const Piece& b) { return a.upper < b.upper; }
};

class BranchAndBound {
 public:
  BranchAndBound(const SignedDistance& solid, const Vec3d& center, double radius, const ProtrusionTolerance& tolerance)
      : solid_(solid), center_(center), radius_(radius), tolerance_(tolerance) {}

  CertifiedProtrusion run() {
    const SignedDistance::Answer atCenter = solid_.query(center_);
    ++queries_;
    depth_ = atCenter.depth;
    result_.depth = depth_;
    result_.witness = center_;
    best_ = std::max(0.0, -depth_);
    const double whole = radius_ - depth_;
    double upper = std::max(whole, 0.0);
    if (whole > 0 && radius_ > 0) {
      offerFarPoint(atCenter.nearest);
      if (!closeEnough(upper)) upper = refine(whole, atCenter.nearest.triangle);
    }
    // The guard covers the queries, and the rounding of the pieces' corners and of the witness by a few units of the
    // same lengths.
    const double guard = 2 * solid_.roundingBound(center_ + Vec3d{radius_, radius_, radius_});
    result_.upper = whole + guard <= 0 ? 0 : upper + guard;
    result_.lower = std::max(0.0, best_ - guard);
    return result_;
  }

 private:
  /// `known`: a triangle that may be near.
  SignedDistance::Answer query(const Vec3d& p, std::uint32_t known) {
    ++queries_;
    return solid_.query(p, solid_.distanceToTriangle(known, p));
  }

  bool closeEnough(double upper) const {
    return upper <= best_ * (1 + tolerance_.relative) + tolerance_.absolute || best_ > tolerance_.ofInterest;
  }

  void offer(const Vec3d& point, double outside) {
    if (outside > best_) {
      best_ = outside;
      result_.witness = point;
    }
  }

  /// A good first witness lies beyond the surface point nearest to the centre, or away from it when the centre is
  /// outside.
  void offerFarPoint(const SurfacePoint& nearest) {
    const Vec3d away = depth_ > 0 ? nearest.point - center_ : center_ - nearest.point;
    const double reach = length(away);
    if (!(reach > 0)) return;
    const Vec3d point = center_ + away * (radius_ / reach);
    offer(point, -query(point, nearest.triangle).depth);
  }

  double refine(double whole, std::uint32_t triangle) {
    for (int octant = 0; octant < 8; ++octant) {
      const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1, z = octant & 4 ? -1 : 1;
      push({{Vec3d{x, 0, 0}, Vec3d{0, y, 0}, Vec3d{0, 0, z}}, 0, radius_, whole, triangle});
    }
    while (!pieces_.empty() && !closeEnough(pieces_.front().upper) && queries_ < tolerance_.maxQueries) {
      std::pop_heap(pieces_.begin(), pieces_.end());
      const Piece piece = pieces_.back();
      pieces_.pop_back();
      split(piece);
    }
    return std::max(best_, pieces_.empty() ? 0.0 : pieces_.front().upper);
  }

  void split(Piece piece) {
    const auto& [a, b, c] = piece.directions;
    piece.inner = std::max(piece.inner, settledRadius());
    const double width = std::max({lengthSq(a - b), lengthSq(b - c), lengthSq(c - a)}) * piece.outer * piece.outer;
    const double height = piece.outer - piece.inner;
    if (height * height > kMaxHeightToWidth * kMaxHeightToWidth * width) {
      const double middle = (piece.inner + piece.outer) / 2;
      push({piece.directions, middle, piece.outer, piece.upper, piece.triangle});
      push({piece.directions, piece.inner, middle, piece.upper, piece.triangle});
      return;
    }
    const Vec3d ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
    push({{ab, bc, ca}, piece.inner, piece.outer, piece.upper, piece.triangle});
    push({{a, ab, ca}, piece.inner, piece.outer, piece.upper, piece.triangle});
    push({{b, bc, ab}, piece.inner, piece.outer, piece.upper, piece.triangle});
    push({{c, ca, bc}, piece.inner, piece.outer, piece.upper, piece.triangle});
  }

  /// Points within this distance of the centre are no farther from the solid than the witness: dist(x) <= |x - c| -
  /// s(c).
  double settledRadius() const { return std::max(0.0, best_ + depth_); }

  /// Bounds a piece by one query, and keeps it if it may hold a point farther than the witness.
  void push(Piece piece) {
    piece.inner = std::max(piece.inner, settledRadius());
    piece.upper = std::min(piece.upper, piece.outer - depth_);
    if (piece.inner >= piece.outer || piece.upper <= best_) return;
    const auto& [a, b, c] = piece.directions;
    const Vec3d middle = normalized(a + b + c);
    const Vec3d point = center_ + middle * piece.outer;
    const SignedDistance::Answer answer = query(point, piece.triangle);
    piece.triangle = answer.nearest.triangle;
    offer(point, -answer.depth);
    piece.upper = boundOnHull(piece, point, answer);
    if (piece.upper <= best_) return;
    pieces_.push_back(piece);
    std::push_heap(pieces_.begin(), pieces_.end());
  }

  /// Returns an upper bound for the piece: the known one or a smaller one.
  double boundOnHull(const Piece& piece, const Vec3d& point, const SignedDistance::Answer& answer) const {
    const auto& [a, b, c] = piece.directions;
    // The plane through a, b, c passes the centre at the distance `cosine`. A unit direction between them is a
    // combination with weights >= 0 whose sum lies in [1, 1 / cosine]. So the piece lies in the hull of the corners at
    // `inner` and at outer / cosine.
    const double cosine = dot(a, normalized(cross(b - a, c - a)));
    const double outer = piece.outer / std::abs(cosine);
    double toPointSq = 0;
    for (const Vec3d& direction : piece.directions)
      for (const double r : {piece.inner, outer})
        toPointSq = std::max(toPointSq, lengthSq(center_ + direction * r - point));
    // The 1-Lipschitz bound; it is the better one where the piece lies inside the solid.
    const double toPoint = std::min(piece.upper, std::sqrt(toPointSq) - answer.depth);
    if (toPoint <= best_) return toPoint;
    double toTriangle = 0;
    for (const Vec3d& direction : piece.directions)
      for (const double r : {piece.inner, outer}) {
        toTriangle = std::max(toTriangle, solid_.distanceToTriangle(answer.nearest.triangle, center_ + direction * r));
        if (toTriangle >= toPoint) return toPoint;
      }
    return toTriangle;
  }

  static constexpr double kMaxHeightToWidth = 2;  // costs from 0.5 to 8 are equal within noise

  const SignedDistance& solid_;
  Vec3d center_;
  double radius_;
  ProtrusionTolerance tolerance_;
  double depth_ = 0;
  double best_ = 0;
  std::uint32_t queries_ = 0;
  std::vector<Piece> pieces_;
  CertifiedProtrusion result_;
};

}  // namespace

ProtrusionTolerance defaultProtrusionTolerance(const SignedDistance& solid) {
  return {0.01, 1e-4 * solid.bounds().diagonal(), 100'000};
}

CertifiedProtrusion certifiedProtrusion(const SignedDistance& solid, const Vec3d& center, double radius,
                                        const ProtrusionTolerance& tolerance) {
  assert(isFinite(center) && std::isfinite(radius) && radius >= 0);
  return BranchAndBound(solid, center, radius, tolerance).run();
}

double protrusionBound(const SignedDistance& solid, const Vec3d& center, double radius, double tolerance) {
  ProtrusionTolerance t = defaultProtrusionTolerance(solid);
  t.absolute = tolerance;
  return certifiedProtrusion(solid, center, radius, t).upper;
}

}  // namespace cairn::builder
