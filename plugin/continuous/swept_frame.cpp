// SPDX-License-Identifier: Zlib
#include "continuous/swept_frame.h"

namespace cairn::bullet {

namespace {

btQuaternion rotationOf(const btMatrix3x3& axes) {
  btQuaternion rotation;
  axes.getRotation(rotation);
  return rotation;
}

}  // namespace

SweptPlace placeBetween(const SweptPlace& x, const SweptPlace& y, btScalar part) {
  const btTransform tree(x.tree.getRotation().slerp(y.tree.getRotation(), part),
                         x.tree.getOrigin().lerp(y.tree.getOrigin(), part));
  return {tree, btMatrix3x3(rotationOf(x.otherAxes).slerp(rotationOf(y.otherAxes), part))};
}

btScalar turnBetween(const SweptPlace& x, const SweptPlace& y) {
  return x.tree.getRotation().angleShortestPath(y.tree.getRotation()) +
         rotationOf(x.otherAxes).angleShortestPath(rotationOf(y.otherAxes));
}

SweptPlace SweptFrame::at(btScalar part) const {
  const btTransform tree = tree_.at(part), other = other_.at(part);
  if (!keepsAxes_) return {other.inverseTimes(tree), btMatrix3x3::getIdentity()};
  return {btTransform(tree.getBasis(), tree.getOrigin() - other.getOrigin()), other.getBasis()};
}

btTransform SweptFrame::inWorld() const {
  const btTransform other = other_.at(0);
  return keepsAxes_ ? btTransform(btMatrix3x3::getIdentity(), other.getOrigin()) : other;
}

}  // namespace cairn::bullet
