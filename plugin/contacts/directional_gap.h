// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/pose.h"

namespace cairn::bullet {

/// Where two surfaces are looked at: along `normal`, near `center`. All lengths and positions in one frame and unit.
struct GapWindow {
  Vec3 normal;  ///< unit, from the lower surface to the upper one
  Vec3 center;
  std::array<float, 2> lower{}, upper{};   ///< bounds across the normal, from the centre, along `across`
  std::array<Vec3, 2> across;              ///< unit; with the normal a right-handed frame
  float upperFloor = 0, upperCeiling = 0;  ///< heights over the centre that count of the upper surface
  float lowerFloor = 0, lowerCeiling = 0;  ///< and of the lower one
  bool isEmpty() const { return !(lower[0] < upper[0] && lower[1] < upper[1]); }
};

/// The window through which two balls that hold a piece of surface each can touch: what both cover, seen along the
/// normal, and each one's own heights, all grown by `reach`. Precondition: `normal` is a unit vector.
GapWindow windowOfBalls(const Vec3& normal, const Vec3& upperCenter, float upperRadius, const Vec3& lowerCenter,
                        float lowerRadius, float reach);

/// Maps points into a window's frame: two coordinates across the normal, and the height, from the window's centre.
struct WindowView {
  Mat3 linear;
  Vec3 translation;
  Vec3 operator*(const Vec3& p) const { return linear * p + translation; }
};

/// From the frame that `toWindows` maps into the window's own.
WindowView viewThrough(const GapWindow& window, const Similarity& toWindows);

/// A place where one surface stands over another.
struct GapPoint {
  float gap = 0;              ///< height of the upper surface over the lower one there, negative where it is below
  Vec3 position;              ///< half-way between the two
  Vec3 upperFace, lowerFace;  ///< unit, outward normals of the two triangles there
  std::uint32_t upper = 0, lower = 0;  ///< these, in the order in which they were taken in
};

/// How far one set of triangles can move against another along a direction before they touch: exact, up to rounding,
/// because the height of one triangle over another is linear over what both cover, so that it is least in a corner of
/// that. Only triangles that face each other count. Buffers are reused.
class DirectionalGap {
 public:
  /// Corners in the window's frame (`viewThrough`), wound so that the triangle's normal points outwards.
  using Corners = std::array<Vec3, 3>;

  /// A new question.
  void begin(const GapWindow& window);
  /// What faces along the window's normal is left out of the upper surface, what faces against it of the lower one.
  /// False when it is, and where it is seen edge-on or lies beside the window.
  bool addUpper(const Corners& corners);
  bool addLower(const Corners& corners);
  /// Pairs that `run` will compare.
  std::uint64_t pairCount() const { return uppers_.size() * lowers_.size(); }

  /// Everything below `reach` in corners of what two triangles cover that is not more than `depth` above the deepest,
  /// in the order they were added; valid until the next `run`. Linear in `pairCount`.
  std::span<const GapPoint> run(float reach, float depth);
  /// Whether any two triangles have a common part in the window, however far apart. Precondition: `run` was called
  /// since `begin`. Linear in `pairCount` where that found nothing, else at once.
  bool anyOverlap() const;

 private:
  struct Box {
    std::array<float, 2> from{}, to{};
    bool meets(const Box& other) const {
      return from[0] <= other.to[0] && other.from[0] <= to[0] && from[1] <= other.to[1] && other.from[1] <= to[1];
    }
  };
  struct Patch {
    Corners corners;
    Box box;
    float floor = 0;
    Vec3 outwards;  // any length
  };
  struct Facet {
    struct Side {
      float x, y, offset;  // inside where x u + y v + offset >= 0, a length
    };
    std::array<Side, 3> sides;
    Vec3 anchor;
    float slopeU = 0, slopeV = 0;
    float ceiling = 0;
    Box box;
    Vec3 outwards;

    float height(const Vec3& p) const { return anchor.z + slopeU * (p.x - anchor.x) + slopeV * (p.y - anchor.y); }
  };
  class Polygon;

  static Box boxOf(const Corners& corners);
  Polygon common(const Patch& upper, const Facet& lower) const;
  bool counts(const Vec3& p, float below) const;
  Vec3 inCallersFrame(const Vec3& direction) const;
  void compare(const Patch& upper, const Facet& lower, float reach);
  bool overlaps(const Patch& upper, const Facet& lower) const;

  GapWindow window_;
  Box frame_;
  std::vector<Patch> uppers_;
  std::vector<Facet> lowers_;
  std::vector<GapPoint> points_;
  float deepest_ = 0;
  bool anyOverlap_ = false;  // met in `run`
};

}  // namespace cairn::bullet
