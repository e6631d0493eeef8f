// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "pile.h"
#include "scenes/truth/exact_check.h"
#include "test_solids.h"

namespace cairn::hard {

/// Two things that meet. A body has its number in the pile, the plane k the number -1 - k; the lesser comes first.
struct MeetingPair {
  int first = -1, second = -1;
  double depth = 0;  ///< metres

  bool isSamePair(int a, int b) const { return first == std::min(a, b) && second == std::max(a, b); }
};

/// Finds which two things of a pile are deepest in each other. It asks the exact check about the bodies' mesh, and the
/// mesh's vertices about planes. So no code of the judged shapes takes part.
class ExactPile {
 public:
  /// `solid`: the mesh of every body of the pile, body frame, closed.
  explicit ExactPile(const test::Solid& solid);

  /// Depths between two bodies are too small by at most a thousandth of the mesh's diagonal.
  MeetingPair deepest(const Pile& pile) const;

 private:
  test::Solid solid_;
  scenes::ExactSurface surface_;
  double tolerance_;
};

}  // namespace cairn::hard
