// SPDX-License-Identifier: Zlib
#include "pairs/pair_write.h"

#include <algorithm>

namespace cairn::bullet {

PairReport write(TreePair& pair, const PairAnswer& answer, const AnswerPolicy& policy, btDispatcher& dispatcher,
                 btManifoldResult& result) {
  PairReport report = answer.report;
  pair.forgetSpeculativeImpulses();
  std::span<const Contact> left = answer.all();
  for (std::size_t k = 0; k < answer.count.size(); ++k) {
    const std::span<const Contact> chosen = left.first(answer.count[k]);
    left = left.subspan(chosen.size());
    const int cluster = static_cast<int>(k);
    if (chosen.empty() && !pair.manifolds.at(cluster)) continue;
    btPersistentManifold* const m = pair.manifold(dispatcher, cluster);
    if (!m) continue;
    pair.writerOf(result).write(*m, chosen);
    // Counts the solver's points: Bullet merges two points at one place.
    const auto points = static_cast<std::uint32_t>(m->getNumContacts());
    report.contacts += points;
    report.exactContacts += std::min<std::uint32_t>(answer.exact[k], points);
    report.manifolds += points > 0 ? 1 : 0;
  }
  if (policy.mayBeInterrupted) pair.surviveRefresh();
  pair.keepGuardedAwake();
  pair.age.answeredAt = pair.motion.relative.placement;
  pair.age.error = report.errorFraction;
  pair.reported.contacts = report.contacts;
  pair.reported.manifolds = report.manifolds;
  pair.manifolds.endFallback();
  pair.manifolds.noteAxes();
  return report;
}

}  // namespace cairn::bullet
