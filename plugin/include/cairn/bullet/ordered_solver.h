// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <cstddef>
#include <span>

#include "cairn/bullet/manifold_order.h"

namespace cairn::bullet {

/// A solver of Bullet that is handed manifolds in an order that their bodies and points alone tell. What goes on far
/// away then changes no bit of a heap, nor does what was removed before: Bullet solves them in the order in which it
/// keeps or sorts them, which both change. Bullet's own switch, `m_deterministicOverlappingPairs`, does that for shapes
/// that have one manifold a pair; trees and compounds have several.
///
///     cairn::bullet::OrderedSolver solver;
///     btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
///
/// Bodies must have been added in the same order, and no budget be shared with what is far away. Joints keep Bullet's
/// order, and `btMultiBodyDynamicsWorld` does not call this. Cost: n log n in the manifolds of a step.
template <class Solver = btSequentialImpulseConstraintSolver>
class OrderedSolver : public Solver {
 public:
  using Solver::Solver;

  btScalar solveGroup(btCollisionObject** bodies, int bodyCount, btPersistentManifold** manifolds, int manifoldCount,
                      btTypedConstraint** constraints, int constraintCount, const btContactSolverInfo& info,
                      btIDebugDraw* drawer, btDispatcher* dispatcher) override {
    if (dispatcher != nullptr) orderManifolds({manifolds, static_cast<std::size_t>(manifoldCount)}, *dispatcher);
    return Solver::solveGroup(bodies, bodyCount, manifolds, manifoldCount, constraints, constraintCount, info, drawer,
                              dispatcher);
  }
};

}  // namespace cairn::bullet
