// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>

#include "cairn/bullet/narrow_phase.h"

class btCollisionDispatcher;

namespace cairn::bullet {

class CreateTreeAlgorithm;
class CreateCompoundAlgorithm;

/// Enters the tree algorithms into a dispatcher's two tables (contacts and closest points), for sphere-trees against
/// every shape that is neither a compound nor soft; compounds reach them child by child through Bullet's own algorithm.
/// A shape of the same type number that is not ours gets what the tables had for it before, and so does a sphere-tree
/// against a GImpact compound, which cannot show its triangles. Compounds that GImpact has taken against its meshes
/// come back to Bullet's own algorithm as long as they have a sphere-tree in them. On destruction the tables get back
/// what they had, where nobody has entered anything since.
class Registration {
 public:
  /// Precondition: `!isOn(dispatcher)`.
  Registration(btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase);
  ~Registration();
  static bool isOn(btCollisionDispatcher& dispatcher);
  /// Enters the tree algorithms again where GImpact has registered itself since, for pairs that are made from now on.
  void renew();
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

 private:
  std::unique_ptr<CreateTreeAlgorithm> contacts_;
  std::unique_ptr<CreateTreeAlgorithm> closestPoints_;
  std::unique_ptr<CreateCompoundAlgorithm> compoundContacts_;
  std::unique_ptr<CreateCompoundAlgorithm> compoundClosestPoints_;
};

}  // namespace cairn::bullet
