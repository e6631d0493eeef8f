// SPDX-License-Identifier: Zlib
// Past the leaves: from the contacts of leaves to those of their source triangles.
#include <algorithm>
#include <limits>

#include "contacts/manifold_writer.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

namespace {

// Contacts of a cluster that are chosen, measured and chosen from again one by one; more than twice what a heap's need.
constexpr int kRoundsOneByOne = 32;
// The gap of one that others stand for.
constexpr float kReplaced = std::numeric_limits<float>::infinity();

bool hasDeeper(const auto& clusters, float depth) {
  return std::ranges::any_of(clusters, [&](std::span<const Contact> members) {
    return std::ranges::any_of(members, [&](const Contact& contact) { return contact.gap < -depth; });
  });
}

bool hasCrossing(const auto& clusters) {
  return std::ranges::any_of(
      clusters, [](std::span<const Contact> members) { return std::ranges::any_of(members, &Contact::isCrossing); });
}

bool canBeSharpened(const Contact& contact) {
  return !contact.isSettled && !contact.ofSpheres;
}

}  // namespace

TreePair::Clusters TreePair::pastLeaves(btManifoldResult& result, Budget& budget, ContactScratch& scratch,
                                        PairReport& report) {
  const auto began = budget.hasDeadline() ? Budget::Clock::now() : Budget::Clock::time_point();
  Clusters clusters;
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    const std::span<const Contact> rough = scratch.contacts.cluster(static_cast<int>(k));
    std::vector<Contact>& members = scratch.refined[k];
    members.assign(rough.begin(), rough.end());
    const HeldContacts held = manifolds_[k] ? writerOf(result).held(*manifolds_[k]) : HeldContacts{};
    goOnToTriangles(members, held.span(), budget);
    clusters[k] = members;
  }
  const Clusters ofLeaves = clustersOf(scratch.contacts);
  if (hasCrossing(clusters) && !hasDeeper(clusters, 0) && hasDeeper(ofLeaves, speculative_)) clusters = ofLeaves;
  const bool isSilent = std::ranges::all_of(clusters, [](std::span<Contact> members) { return members.empty(); });
  if (isSilent && wasDone_ && !contacts_.isOfMesh()) clusters = breakSilence(budget, scratch);
  if (budget.hasDeadline()) report.onTriangles += Budget::Clock::now() - began;
  return clusters;
}

// Triangles that do not face each other say nothing in any direction that is tried, and leaves may have left out what
// overlaps: a pair is silent only if no triangles cross. Where that is not found out, the leaves have the last word.
TreePair::Clusters TreePair::breakSilence(Budget& budget, ContactScratch& scratch) {
  if (contacts_.isUncrossedAt(motion_.placement)) return {};
  scratch.crossing.clear();
  const std::optional<float> apart = counterpart_->appendCrossing(contacts_.gapOfInterest(), budget, scratch.crossing);
  if (apart && scratch.crossing.empty()) {
    contacts_.setUncrossed(*apart, motion_);
    return {};
  }
  if (!scratch.crossing.empty()) contacts_.replaceAll(scratch.crossing, reach_, scratch);
  return clustersOf(scratch.contacts);
}

// The contacts that would be chosen are measured between source triangles, and what comes of it is chosen from again,
// until all that are chosen are settled. Triangles are never deeper than their regions (up to what sixteen support
// points leave out), so nothing deeper is left behind, and most contacts never have to be looked at. The first that the
// budget does not cover ends it: what is left when time is up must cost next to nothing.
void TreePair::goOnToTriangles(std::vector<Contact>& members, std::span<const ContactId> held, Budget& budget) const {
  std::size_t more = 0;
  for (int round = 0;; ++round) {
    const ContactChoice choice = chooseContacts(members, held, kSeparationFactor * speculative_, speculative_);
    const auto chosen = std::span(choice.index).first(static_cast<std::size_t>(choice.count));
    const auto open =
        std::ranges::find_if(chosen, [&](int i) { return canBeSharpened(members[static_cast<std::size_t>(i)]); });
    if (open == chosen.end()) return;
    if (round >= kRoundsOneByOne) more = std::max<std::size_t>(2 * more, kMaxPoints);
    const bool isCovered = sharpen(members, static_cast<std::size_t>(*open), more, budget);
    std::sort(members.begin(), members.end(), deeper);
    while (!members.empty() && members.back().gap == kReplaced) members.pop_back();
    if (!isCovered) return;
  }
}

// That one, and so many more of the deepest: where most turn out to be in vain, choosing anew for each would take the
// square of their number.
bool TreePair::sharpen(std::vector<Contact>& members, std::size_t one, std::size_t more, Budget& budget) const {
  const auto replace = [&](std::size_t i) {
    Contact rough = members[i];
    rough.isSettled = true;
    if (!counterpart_->sharpen(rough, budget, members)) return false;
    members[i].gap = kReplaced;
    return true;
  };
  if (!replace(one)) return false;
  for (std::size_t i = 0, count = members.size(); i < count && more > 0; ++i) {
    if (i == one || !canBeSharpened(members[i])) continue;
    if (!replace(i)) return false;
    --more;
  }
  return true;
}

}  // namespace cairn::bullet
