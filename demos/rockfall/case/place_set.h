// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall {

/// A set of places on the map, from which places are drawn evenly: points, lines by their length, or areas by their
/// size. It is made of pieces, each with its share.
class PlaceSet {
 public:
  /// Corners of a trapezoid with two sides along x, the lower side first, each side from its left to its right end. A
  /// line is one without width, a point one that is a point.
  using Piece = std::array<MapPoint, 4>;

  /// Precondition: `weight` is positive.
  void add(const Piece& piece, double weight);
  void addPoint(const MapPoint& point);
  void addLine(const Polyline& line);
  /// Cut into trapezoids between its corners' heights: about as many as it has corners, and more where it is ragged. An
  /// area of size zero adds nothing. Returns false, the area in part, if the set would have more than a million pieces.
  [[nodiscard]] bool addArea(const Area& area);

  bool empty() const { return pieces_.empty(); }
  const std::vector<Piece>& pieces() const { return pieces_; }
  void moveBy(const MapPoint& by);
  /// The place of three even random numbers from [0, 1). Logarithmic in the pieces. Precondition: not empty.
  MapPoint at(double which, double along, double across) const;
  /// The place of two even random numbers in one piece.
  MapPoint in(std::size_t piece, double along, double across) const;

 private:
  std::vector<Piece> pieces_;
  std::vector<double> upTo_;  // the sum of the weights with each piece
};

}  // namespace cairn::rockfall
