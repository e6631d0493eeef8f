// SPDX-License-Identifier: Zlib
#include "pairs/pair_finish.h"

#include <algorithm>
#include <utility>

namespace cairn::bullet {

namespace {

using Clusters = std::array<std::span<Contact>, kMaxClusters>;

Clusters clustersOf(ClusteredContacts& contacts) {
  Clusters clusters;
  for (std::size_t k = 0; k < clusters.size(); ++k) clusters[k] = contacts.cluster(static_cast<int>(k));
  return clusters;
}

bool isOfMeshes(const Contact& contact) {
  return contact.isExact && contact.pair == NodePair{kRootNode, kRootNode};
}

// What a step that can be interrupted goes on with.
void remember(TreePair& pair, const Contact& chosen, const AnswerPolicy& policy) {
  if (chosen.ofSpheres || (!policy.mayBeInterrupted && isOfMeshes(chosen))) return;
  pair.contacts.known().remember(pair.counterpart->leavesOf(chosen));
}

void writeCluster(TreePair& pair, int k, std::span<Contact> members, const AnswerPolicy& policy,
                  btDispatcher& dispatcher, btManifoldResult& result, PairReport& report) {
  if (members.empty() && !pair.manifolds.at(k)) return;
  btPersistentManifold* const m = pair.manifold(dispatcher, k);
  if (!m) return;
  ManifoldWriter writer = pair.writerOf(result);
  const ContactChoice choice = pair.choose(members, writer.held(*m));
  writer.write(*m, members, choice);
  // What the solver gets: Bullet takes two that come to one place for one.
  const auto points = static_cast<std::uint32_t>(m->getNumContacts());
  std::uint32_t exact = 0;
  for (int i = 0; i < choice.count; ++i) {
    const Contact& chosen = members[static_cast<std::size_t>(choice.index[static_cast<std::size_t>(i)])];
    remember(pair, chosen, policy);
    const float ofPair = pair.traversal().pairError(chosen.pair);
    const float error = chosen.isExact ? std::min(chosen.exactError, ofPair) : ofPair;
    report.errorFraction = std::max(report.errorFraction, double(error) / double(pair.sizes.smaller));
    exact += chosen.isExact ? 1 : 0;
  }
  report.contacts += points;
  report.exactContacts += std::min(exact, points);
  report.manifolds += points > 0 ? 1 : 0;
}

// Of what the traversal reached, and of what it had ruled out before the bodies came here; but no more than that of
// whole bodies.
float errorOf(TreePair& pair) {
  const float reached = PairContacts::frontError(*pair.counterpart);
  if (pair.contacts.isKept()) return reached;
  return std::min(reached + pair.contacts.age().sinceTraversal(),
                  std::max(reached, pair.traversal().pairError({kRootNode, 0})));
}

}  // namespace

PairReport finish(TreePair& pair, btDispatcher& dispatcher, btManifoldResult& result, const AnswerPolicy& policy,
                  Budget& budget, ContactScratch& scratch) {
  budget.redeem(std::exchange(pair.work.promised, {}));
  Traversal& traversal = pair.traversal();
  PairReport report;
  pair.work.wasDone = traversal.done();
  report.isUnresolved = !pair.work.wasDone;
  report.errorFraction = pair.sizes.fraction(errorOf(pair));
  pair.contacts.finish(*pair.counterpart, policy, pair.motion.relative, pair.sizes.reach, pair.course.ahead, budget,
                       scratch);
  report.onTriangles = pair.contacts.onTriangles();
  pair.age.answeredAt = pair.motion.relative.placement;
  pair.forgetImpulsesAhead();
  const Clusters clusters = clustersOf(scratch.contacts);
  for (std::size_t k = 0; k < clusters.size(); ++k)
    writeCluster(pair, static_cast<int>(k), clusters[k], policy, dispatcher, result, report);
  if (policy.mayBeInterrupted) {
    pair.contacts.expectInterruptions();
    pair.contacts.known().rememberDeepest(*pair.counterpart, scratch.contacts.list());
    pair.surviveRefresh();
  }
  pair.holdGuards();
  report.errorFraction += double(pair.contacts.overlooked() / pair.sizes.smaller);
  pair.age.error = report.errorFraction;
  pair.said.contacts = report.contacts;
  pair.said.manifolds = report.manifolds;
  if (pair.work.wasDone) pair.age.waited = 0;
  pair.manifolds.endStandIn();
  pair.manifolds.noteAxes();
  return report;
}

}  // namespace cairn::bullet
