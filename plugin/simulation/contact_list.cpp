// SPDX-License-Identifier: Zlib
#include "simulation/contact_list.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace cairn::simulation {

namespace {

using bullet::asSphereTree;
using bullet::PairAnswered;
using Objects = std::pair<const btCollisionObject*, const btCollisionObject*>;

Objects inOrder(const btCollisionObject* a, const btCollisionObject* b) {
  return std::less<>()(b, a) ? Objects{b, a} : Objects{a, b};
}

// The answer to a pair, of a list that is sorted by objects; null for pairs without a tree.
const PairAnswered* answerOf(const std::vector<PairAnswered>& sorted, const Objects& objects) {
  const auto isBefore = [](const PairAnswered& answer, const Objects& o) {
    return inOrder(answer.first, answer.second) < o;
  };
  const auto found = std::lower_bound(sorted.begin(), sorted.end(), objects, isBefore);
  return found != sorted.end() && inOrder(found->first, found->second) == objects ? &*found : nullptr;
}

double sizeOf(const btCollisionObject* object) {
  const bullet::SphereTreeShape* const tree = asSphereTree(object->getCollisionShape());
  return tree ? double(tree->size()) : std::numeric_limits<double>::infinity();
}

void append(const btPersistentManifold& manifold, const PairAnswered* answer, std::vector<Contact>& contacts) {
  const btCollisionObject *a = manifold.getBody0(), *b = manifold.getBody1();
  const double error = answer ? answer->errorFraction * std::min(sizeOf(a), sizeOf(b)) : 0;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    Contact contact;
    contact.point = point.getPositionWorldOnB();
    contact.normal = point.m_normalWorldOnB;
    contact.depth = float(-point.getDistance());
    contact.error = float(error);
    contact.impulse = float(point.m_appliedImpulse);
    contact.a = a->getUserIndex();
    contact.b = b->getUserIndex();
    contact.isResolved = !(answer && answer->isUnresolved);
    contacts.push_back(contact);
  }
}

}  // namespace

void listContacts(const Simulation& simulation, std::vector<Contact>& contacts) {
  // Bullet's reader is not const.
  auto& manifolds = const_cast<bullet::Dispatcher<>&>(simulation.narrowPhase());
  std::vector<PairAnswered> answers = simulation.narrowPhase().lastAnswers();
  std::ranges::sort(answers, [](const PairAnswered& x, const PairAnswered& y) {
    return inOrder(x.first, x.second) < inOrder(y.first, y.second);
  });
  contacts.clear();
  for (int i = 0; i < manifolds.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *manifolds.getManifoldByIndexInternal(i);
    append(manifold, answerOf(answers, inOrder(manifold.getBody0(), manifold.getBody1())), contacts);
  }
}

}  // namespace cairn::simulation
