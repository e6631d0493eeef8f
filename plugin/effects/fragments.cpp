// SPDX-License-Identifier: Zlib
#include "cairn/effects/fragments.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include "placement/bullet_math.h"

namespace cairn::effects {
namespace {

using bullet::toBullet;
using bullet::toVec3d;

// Mass, centre and inertia about it of several pieces, mesh axes, metres and kilograms.
struct Mass {
  double mass = 0, volume = 0;
  Vec3d center{0, 0, 0};
  Mat3d inertia;
};

Mass massOf(const FragmentPart& part, std::span<const std::uint32_t> pieces) {
  const double scale = double(part.scale);
  Mass sum;
  for (const std::uint32_t piece : pieces) {
    const MassProperties& own = part.kind->pieces[piece]->mass();
    const double volume = own.volume * scale * scale * scale;
    sum.volume += volume;
    sum.center = sum.center + own.centerOfMass * (scale * volume);
  }
  sum.center = sum.center * (1 / sum.volume);
  sum.mass = sum.volume * double(part.density);
  for (Vec3d& row : sum.inertia.rows) row = {0, 0, 0};
  for (const std::uint32_t piece : pieces) {
    const MassProperties& own = part.kind->pieces[piece]->mass();
    const double mass = own.volume * scale * scale * scale * double(part.density);
    const Vec3d d = own.centerOfMass * scale - sum.center;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        sum.inertia(row, column) +=
            mass * (own.inertia(row, column) * scale * scale + (row == column ? lengthSq(d) : 0) - d[row] * d[column]);
  }
  return sum;
}

// The others of a body's pieces in groups that hang together.
std::vector<std::vector<std::uint32_t>> groupsWithout(const FragmentPart& part, std::uint32_t piece) {
  std::vector<std::uint32_t> group(part.kind->pieces.size());
  std::iota(group.begin(), group.end(), 0U);
  const auto isThere = [&](std::uint32_t p) { return p != piece && std::ranges::binary_search(part.pieces, p); };
  for (const auto& [a, b] : part.kind->bonds) {
    if (!isThere(a) || !isThere(b) || group[a] == group[b]) continue;
    const std::uint32_t from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
    std::ranges::replace(group, from, to);
  }
  std::vector<std::vector<std::uint32_t>> groups;
  for (std::uint32_t first = 0; first < group.size(); ++first) {
    std::vector<std::uint32_t> members;
    for (const std::uint32_t p : part.pieces)
      if (p != piece && group[p] == first) members.push_back(p);
    if (!members.empty()) groups.push_back(std::move(members));
  }
  return groups;
}

// The body's shape, for a body's frame that is placed in the mesh's frame (times scale).
Status makeShapes(FragmentBody& body) {
  auto compound = body.part.pieces.size() > 1 ? std::make_unique<btCompoundShape>() : nullptr;
  for (const std::uint32_t piece : body.part.pieces) {
    const auto frame = compound ? bullet::BodyFrame::mesh : bullet::BodyFrame::principalAxes;
    auto shape = bullet::SphereTreeShape::create(body.part.kind->pieces[piece], frame, body.part.scale);
    if (!shape) return shape.error();
    if (compound)
      compound->addChildShape(body.part.bodyFromMesh, shape.value().get());
    else
      body.part.bodyFromMesh = shape.value()->bodyFromMesh();
    body.shapes.push_back(std::move(shape).value());
  }
  if (compound) body.shapes.push_back(std::move(compound));
  return {};
}

Result<FragmentBody> bodyOf(const btRigidBody& old, const FragmentPart& from, std::vector<std::uint32_t> pieces) {
  FragmentBody body;
  const Mass mass = massOf(from, pieces);
  body.part = {from.kind, std::move(pieces), from.scale, from.density};
  body.mass = btScalar(mass.mass);
  body.volume = btScalar(mass.volume);
  if (body.part.pieces.size() > 1) {
    btMatrix3x3 inertia = toBullet(mass.inertia), meshFromBody;
    inertia.diagonalize(meshFromBody, std::numeric_limits<btScalar>::epsilon(), 30);
    body.inertia = {inertia[0][0], inertia[1][1], inertia[2][2]};
    body.part.bodyFromMesh = btTransform(meshFromBody, toBullet(mass.center)).inverse();
  }
  if (const Status made = makeShapes(body); !made) return made.error();
  if (body.part.pieces.size() == 1) body.shape().calculateLocalInertia(body.mass, body.inertia);
  body.pose = old.getWorldTransform() * from.bodyFromMesh * body.part.bodyFromMesh.inverse();
  body.angularVelocity = old.getAngularVelocity();
  body.linearVelocity = old.getVelocityInLocalPoint(body.pose.getOrigin() - old.getCenterOfMassPosition());
  return body;
}

}  // namespace

FragmentPart FragmentPart::whole(std::shared_ptr<const Fragments> kind, const bullet::SphereTreeShape& shape,
                                 btScalar density) {
  FragmentPart part{std::move(kind), {}, shape.scale(), density, shape.bodyFromMesh()};
  part.pieces.resize(part.kind->pieces.size());
  std::iota(part.pieces.begin(), part.pieces.end(), 0U);
  return part;
}

std::uint32_t nearestPiece(const btRigidBody& body, const FragmentPart& part, const btVector3& place) {
  assert(!part.pieces.empty());
  const btTransform meshFromWorld = (body.getWorldTransform() * part.bodyFromMesh).inverse();
  const Vec3d inMesh = toVec3d(meshFromWorld * place) * (1 / double(part.scale));
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = part.pieces.front();
  for (const std::uint32_t piece : part.pieces) {
    const SphereTreeData& data = part.kind->pieces[piece]->data();
    std::vector<bool> isLeaf(data.nodes.size(), true);
    for (std::size_t i = 1; i < data.nodes.size(); ++i) isLeaf[data.nodes[i].parent] = false;
    for (std::size_t i = 0; i < data.nodes.size(); ++i) {
      if (!isLeaf[i]) continue;
      const double distance = length(data.origin + Vec3d(data.nodes[i].center) - inMesh) - double(data.nodes[i].radius);
      if (distance >= least) continue;
      least = distance;
      nearest = piece;
    }
  }
  return nearest;
}

Result<std::vector<FragmentBody>> breakOff(const btRigidBody& body, const FragmentPart& part, std::uint32_t piece) {
  assert(part.pieces.size() > 1 && std::ranges::binary_search(part.pieces, piece));
  std::vector<std::vector<std::uint32_t>> groups = groupsWithout(part, piece);
  groups.insert(groups.begin(), {piece});
  std::vector<FragmentBody> bodies;
  for (std::vector<std::uint32_t>& group : groups) {
    auto made = bodyOf(body, part, std::move(group));
    if (!made) return made.error();
    bodies.push_back(std::move(made).value());
  }
  return bodies;
}

}  // namespace cairn::effects
