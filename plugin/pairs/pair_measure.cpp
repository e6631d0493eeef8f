// SPDX-License-Identifier: Zlib
#include "pairs/pair_measure.h"

#include <algorithm>
#include <utility>

namespace cairn::bullet {

namespace {

bool isOfMeshes(const Contact& contact) {
  return contact.isExact && contact.pair == NodePair{kRootNode, kRootNode};
}

// Remembers the leaf pairs with which an interruptible step continues.
void remember(TreePair& pair, const Contact& chosen, const AnswerPolicy& policy) {
  if (chosen.ofSpheres || (!policy.mayBeInterrupted && isOfMeshes(chosen))) return;
  pair.contacts.known().remember(pair.collider->leavesOf(chosen));
}

double errorFractionOf(TreePair& pair, const Contact& chosen) {
  const float ofPair = pair.traversal().pairError(chosen.pair);
  const float error = chosen.isExact ? std::min(chosen.exactError, ofPair) + pair.collider->meshError() : ofPair;
  return double(error) / double(pair.sizes.smaller);
}

void choose(TreePair& pair, const AnswerPolicy& policy, ContactScratch& scratch, PairAnswer& answer) {
  answer.list = &scratch.chosen;
  answer.first = scratch.chosen.size();
  for (int k = 0; k < kMaxClusters; ++k) {
    const std::span<const Contact> chosen = pair.choose(k, scratch.contacts.cluster(k));
    for (const Contact& contact : chosen) {
      remember(pair, contact, policy);
      answer.report.errorFraction = std::max(answer.report.errorFraction, errorFractionOf(pair, contact));
    }
    const auto i = static_cast<std::size_t>(k);
    answer.count[i] = static_cast<std::uint8_t>(chosen.size());
    answer.exact[i] = static_cast<std::uint8_t>(std::ranges::count_if(chosen, &Contact::isExact));
    scratch.chosen.insert(scratch.chosen.end(), chosen.begin(), chosen.end());
  }
}

// Certified error of the front and of surfaces ruled out before the bodies came here, at most that of root spheres.
float errorOf(TreePair& pair) {
  const float reached = PairContacts::frontError(*pair.collider);
  if (pair.contacts.isCached()) return reached;
  return std::min(reached + pair.contacts.age().sinceTraversal(),
                  std::max(reached, pair.traversal().pairError({kRootNode, 0})));
}

}  // namespace

PairAnswer measure(TreePair& pair, const AnswerPolicy& policy, Budget& budget, ContactScratch& scratch) {
  budget.release(std::exchange(pair.work.reserved, {}));
  PairAnswer answer;
  PairReport& report = answer.report;
  pair.work.wasDone = pair.isDone();
  report.isUnresolved = !pair.work.wasDone;
  report.errorFraction = pair.sizes.fraction(errorOf(pair));
  pair.contacts.finish(*pair.collider, policy, pair.motion.relative, pair.sizes.maxSeparation,
                       pair.trajectory.speculative, budget, scratch);
  report.onTriangles = pair.contacts.onTriangles();
  report.isOfMesh = pair.contacts.isOfTriangles();
  if (report.isOfMesh)
    report.errorFraction = std::max(report.errorFraction, pair.sizes.fraction(pair.collider->meshError()));
  choose(pair, policy, scratch, answer);
  if (policy.mayBeInterrupted) {
    pair.contacts.expectInterruptions();
    pair.contacts.known().rememberDeepest(*pair.collider, scratch.contacts.list());
  }
  report.errorFraction += double(pair.contacts.staleness() / pair.sizes.smaller);
  if (pair.work.wasDone) pair.age.waited = 0;
  return answer;
}

}  // namespace cairn::bullet
