// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <cstddef>
#include <span>
#include <type_traits>

#include "cairn/bullet/manifold_order.h"
#include "cairn/core/export.h"

namespace cairn::bullet {

/// A Bullet solver that gets the manifolds sorted by data of their bodies and points alone (`orderManifolds`). Bodies
/// far away, and bodies removed earlier, then change no bit of a heap's motion. Bullet's own order depends on both.
///
///     cairn::bullet::OrderedSolver solver;
///     btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
///
/// Bullet's switch `m_deterministicOverlappingPairs` does the same only for shapes with one manifold a pair. Trees and
/// compounds have several.
///
/// Preconditions: the bodies were added in the same order, and share no budget with distant bodies. Joints keep
/// Bullet's order. `btMultiBodyDynamicsWorld` does not call this. Cost: n log n in the manifolds of a step.
template <class Solver = btSequentialImpulseConstraintSolver>
class OrderedSolver : public Solver {
 public:
  using Solver::Solver;

  /// Bullet calls this once a step, or once an island: orders the manifolds, then solves as `Solver` does.
  btScalar solveGroup(btCollisionObject** bodies, int bodyCount, btPersistentManifold** manifolds, int manifoldCount,
                      btTypedConstraint** constraints, int constraintCount, const btContactSolverInfo& info,
                      btIDebugDraw* drawer, btDispatcher* dispatcher) override {
    if (dispatcher != nullptr) orderManifolds({manifolds, static_cast<std::size_t>(manifoldCount)}, *dispatcher);
    return Solver::solveGroup(bodies, bodyCount, manifolds, manifoldCount, constraints, constraintCount, info, drawer,
                              dispatcher);
  }

 private:
  static constexpr bool kIsOfPlain = std::is_same_v<Solver, btSequentialImpulseConstraintSolver>;

  [[maybe_unused]] bool isKnown_ = kIsOfPlain && rememberOrderedSolver(this);
};

}  // namespace cairn::bullet
