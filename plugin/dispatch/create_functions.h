// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>

#include <memory>

#include "cairn/bullet/narrow_phase.h"

class btCollisionDispatcher;

namespace cairn::bullet {

/// Enters the tree algorithms into a dispatcher's two tables (contacts and closest points), for sphere-trees against
/// every shape that is neither a compound nor soft; compounds reach them child by child through Bullet's own algorithm.
/// A shape of the same type number that is not ours gets what the dispatcher's configuration has for it, and so does a
/// sphere-tree against a concave shape that cannot show its triangles. Undone on destruction.
class Registration {
 public:
  Registration(btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase);
  ~Registration();
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

 private:
  btCollisionDispatcher& dispatcher_;
  std::unique_ptr<btCollisionAlgorithmCreateFunc> contacts_;
  std::unique_ptr<btCollisionAlgorithmCreateFunc> closestPoints_;
};

}  // namespace cairn::bullet
