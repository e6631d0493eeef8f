// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/check_view.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace cairn::builder {
namespace {

bool areFinite(const ViewJoint& joint) {
  double sum = joint.lower + joint.upper;
  for (int axis = 0; axis < 3; ++axis) {
    sum += joint.translation[axis] + joint.axis[axis];
    for (int column = 0; column < 3; ++column) sum += joint.rotation(axis, column);
  }
  if (joint.mimic) sum += joint.mimic->multiplier + joint.mimic->offset;
  return std::isfinite(sum);
}

Status checkJoint(const View& view, const ViewJoint& joint) {
  const auto refused = [&](const char* why) { return Error{fmt::format("joint '{}' {}", joint.name, why)}; };
  if (joint.parent >= view.links.size() || joint.child >= view.links.size())
    return refused("hangs on a link that there is not; correct its indices");
  if (!areFinite(joint)) return refused("has numbers that are not finite; correct them");
  if (joint.lower > joint.upper) return refused("has a lower limit above its upper one; exchange them");
  if (!joint.mimic) return {};
  if (joint.mimic->joint >= view.joints.size()) return refused("follows a joint that there is not; correct its index");
  if (view.joints[joint.mimic->joint].mimic)
    return refused("follows a joint that follows another; let both follow the first");
  return {};
}

/// Every way from a link to its parents ends, within as many steps as there are links.
Status checkTrees(const View& view) {
  std::vector<std::optional<std::uint32_t>> parents(view.links.size());
  for (const ViewJoint& joint : view.joints) {
    if (parents[joint.child])
      return Error{fmt::format("joint '{}': its child hangs on another joint too; remove one", joint.name)};
    parents[joint.child] = joint.parent;
  }
  for (std::uint32_t link = 0; link < parents.size(); ++link) {
    std::uint32_t at = link;
    for (std::size_t steps = 0; parents[at]; ++steps) {
      if (steps == parents.size())
        return Error{fmt::format("link '{}' hangs in a ring of joints; remove one", view.links[link].name)};
      at = *parents[at];
    }
  }
  return {};
}

}  // namespace

Status checkView(const View& view) {
  if (view.links.empty()) return Error{"a page needs a link to show; give one"};
  for (const ViewJoint& joint : view.joints)
    if (Status s = checkJoint(view, joint); !s) return s;
  for (const auto& [a, b] : view.ignoredPairs)
    if (a >= view.links.size() || b >= view.links.size())
      return Error{fmt::format("the pair of links {} and {} to ignore names a link that there is not", a, b)};
  return checkTrees(view);
}

}  // namespace cairn::builder
