// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>

#include "cairn/bullet/narrow_phase.h"

class btCollisionDispatcher;

namespace cairn::bullet {

class CreateTreeAlgorithm;
class CreateCompoundAlgorithm;

/// Enters the tree algorithms into a dispatcher's two tables (contacts and closest points). They serve sphere-trees
/// against every shape that is neither a compound nor soft. Compounds reach them child by child through Bullet's own
/// algorithm.
///
/// The tables' former entries still serve other shapes of the same type number, and sphere-trees against GImpact
/// compounds, which cannot show their triangles. Where GImpact has taken compounds, those with a sphere-tree go back to
/// Bullet's own algorithm. On destruction every entry that nobody replaced since is restored.
class Registration {
 public:
  /// Precondition: `!isOn(dispatcher)`.
  Registration(btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase);
  ~Registration();
  static bool isOn(btCollisionDispatcher& dispatcher);
  /// Enters the tree algorithms again where GImpact has registered itself since. This affects pairs made from now on.
  void renew();
  /// The tables get back what they had as soon as they are asked, not at once: they may be gone. This must stay.
  void leave();
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

 private:
  std::unique_ptr<CreateTreeAlgorithm> contacts_;
  std::unique_ptr<CreateTreeAlgorithm> closestPoints_;
  std::unique_ptr<CreateCompoundAlgorithm> compoundContacts_;
  std::unique_ptr<CreateCompoundAlgorithm> compoundClosestPoints_;
  bool isLeft_ = false;
};

}  // namespace cairn::bullet
