// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "balls/piece.h"
#include "cairn/builder/ball.h"

namespace cairn::builder {

/// The costs of pieces for some balls (`costOf`), several balls at a time with the fastest instruction set present. The
/// bits do not depend on the instruction set.
class PieceCosts {
 public:
  explicit PieceCosts(std::span<const Ball> balls);

  /// Returns the cost of the piece for each ball, in their order. The span is valid until the next call.
  std::span<const double> of(const Piece& piece);

 private:
  std::size_t size_;
  std::vector<double> x_, y_, z_, depth_, costs_;  // by ball, padded to whole vectors
};

}  // namespace cairn::builder
