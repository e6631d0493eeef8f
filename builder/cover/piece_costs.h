// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "balls/piece.h"
#include "cairn/builder/ball.h"

namespace cairn::builder {

/// What pieces cost some balls (`costOf`), several balls at a time with the fastest instruction set present; the same
/// bits on every one.
class PieceCosts {
 public:
  explicit PieceCosts(std::span<const Ball> balls);

  /// What the piece costs each of the balls, in their order; good until the next call.
  std::span<const double> of(const Piece& piece);

 private:
  std::size_t size_;
  std::vector<double> x_, y_, z_, depth_, costs_;  // by ball, padded to whole vectors
};

}  // namespace cairn::builder
