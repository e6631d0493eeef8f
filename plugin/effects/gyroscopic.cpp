// SPDX-License-Identifier: Zlib
#include "cairn/effects/gyroscopic.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn::effects {
namespace {

constexpr int kGyroscopicFlags = BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD |
                                 BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// By Cramer's rule; false if it is singular.
bool solve(const Matrix& columns, const Vector& right, Vector& x) {
  const Vector yz = cross(columns[1], columns[2]);
  const double determinant = dot(columns[0], yz);
  if (determinant == 0 || !std::isfinite(determinant)) return false;
  x = {dot(right, yz) / determinant, dot(columns[0], cross(right, columns[2])) / determinant,
       dot(columns[0], cross(columns[1], right)) / determinant};
  return true;
}

// The midpoint rule's residual I (w1 - w0) - t (I w) x w at the middle w of w0 and w1, in units of moment times spin.
struct MidpointRule {
  Vector moments, before;
  double time;

  Vector times(const Vector& w) const { return {moments[0] * w[0], moments[1] * w[1], moments[2] * w[2]}; }
  Vector middle(const Vector& after) const {
    return {(before[0] + after[0]) / 2, (before[1] + after[1]) / 2, (before[2] + after[2]) / 2};
  }
  Vector residual(const Vector& after) const {
    const Vector w = middle(after), turned = cross(times(w), w);
    Vector r;
    for (std::size_t i = 0; i < 3; ++i) r[i] = moments[i] * (after[i] - before[i]) - time * turned[i];
    return r;
  }
  // Columns of its derivative by w1: I - t/2 ((I e) x w + (I w) x e) for each axis e.
  Matrix derivative(const Vector& after) const {
    const Vector w = middle(after), momentum = times(w);
    Matrix columns;
    for (std::size_t i = 0; i < 3; ++i) {
      Vector axis{};
      axis[i] = 1;
      const Vector first = cross(times(axis), w), second = cross(momentum, axis);
      for (std::size_t j = 0; j < 3; ++j) columns[i][j] = (i == j ? moments[i] : 0) - time / 2 * (first[j] + second[j]);
    }
    return columns;
  }
};

Vector toArray(const btVector3& v) {
  return {double(v.x()), double(v.y()), double(v.z())};
}

}  // namespace

btVector3 Gyroscopic::spinAfter(const btVector3& moments, const btVector3& spin, btScalar time) {
  constexpr int kSteps = 20;
  // Of the residual to the momentum; the square is what is compared. Convergence is quadratic: one more step from here
  // leaves nothing but rounding.
  constexpr double kTolerance = 1e-10;
  const MidpointRule rule{toArray(moments), toArray(spin), double(time)};
  const Vector momentum = rule.times(rule.before);
  const double enough = kTolerance * kTolerance * dot(momentum, momentum);
  Vector after = rule.before, change{};
  for (int i = 0; i < kSteps; ++i) {
    const Vector residual = rule.residual(after);
    if (!solve(rule.derivative(after), residual, change)) break;
    for (std::size_t j = 0; j < 3; ++j) after[j] -= change[j];
    if (dot(residual, residual) <= enough)
      return {static_cast<btScalar>(after[0]), static_cast<btScalar>(after[1]), static_cast<btScalar>(after[2])};
  }
  return spin;
}

void Gyroscopic::welcome(Body& known) {
  if (taken_.size() <= known.id) taken_.resize(known.id + 1);
  btRigidBody& body = *known.body;
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  const auto [least, greatest] = std::minmax({inverse.x(), inverse.y(), inverse.z()});
  if (!(least > 0) || greatest < options_.minInertiaRatio * least) return;
  const btVector3 moments(1 / inverse.x(), 1 / inverse.y(), 1 / inverse.z());
  taken_[known.id] = {true, body.getFlags() & kGyroscopicFlags, moments};
  body.setFlags(body.getFlags() & ~kGyroscopicFlags);
}

void Gyroscopic::dismiss(Body& known) {
  Taken& taken = taken_[known.id];
  if (taken.isTaken) known.body->setFlags(known.body->getFlags() | taken.flags);
  taken.isTaken = false;
}

std::uint32_t Gyroscopic::applyForces(std::span<Body* const> bodies, const Step& step) {
  std::uint32_t acted = 0;
  for (const Body* known : bodies) {
    const Taken& taken = taken_[known->id];
    btRigidBody& body = *known->body;
    if (!taken.isTaken || body.getAngularVelocity().fuzzyZero()) continue;
    const btMatrix3x3& axes = body.getCenterOfMassTransform().getBasis();
    const btVector3 spin = body.getAngularVelocity() * axes;
    body.setAngularVelocity(axes * spinAfter(taken.moments, spin, step.timeStep));
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects
