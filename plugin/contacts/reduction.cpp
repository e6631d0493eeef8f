// SPDX-License-Identifier: Zlib
#include "contacts/reduction.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace cairn::bullet {

namespace {

// A contact of the last step stays unless another is better by this much. In length that is 10 % (21 % in area), in
// depth a quarter of the speculative distance. With less, the choice flickers with rounding. With more, contacts lag
// behind a rolling body.
constexpr float kLengthBonus = 1.1F;
constexpr float kAreaBonus = kLengthBonus * kLengthBonus;
constexpr float kDepthBonus = 0.25F;
constexpr float kMinPart = 0.01F;

// Up to four contacts of a cluster, as indices into it.
struct ContactChoice {
  std::array<std::size_t, kMaxPoints> index{};
  std::size_t count = 0;
};

class Chooser {
 public:
  Chooser(std::span<const Contact> cluster, float separation, float maxSeparation)
      : cluster_(cluster), separationSq_(separation * separation), maxSeparation_(maxSeparation) {}

  ContactChoice run() {
    pick([&](const Contact& c) { return (c.isInManifold ? kDepthBonus * maxSeparation_ : 0) - c.separation; },
         -kInfinity);
    if (cluster_.size() > 1) pickFarthest();
    if (choice_.count == 2) pickLargestTriangle();
    if (choice_.count == 3) pickLargestGain();
    return choice_;
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  const Vec3& chosen(std::size_t k) const { return cluster_[choice_.index[k]].position; }

  // Weight of a contact: 1 where it touches or is as deep as the deepest, and `kMinPart` at the speculative distance.
  // So a lying cylinder keeps the far ends of its contact line, and not points in front of it or behind.
  float share(const Contact& c) const {
    const float lowest = std::max(cluster_[choice_.index[0]].separation, 0.0F);
    return std::clamp(1 - (c.separation - lowest) / maxSeparation_, kMinPart, 1.0F);
  }

  bool isSeparated(const Contact& c) const {
    for (std::size_t k = 0; k < choice_.count; ++k)
      if (lengthSq(c.position - chosen(k)) < separationSq_) return false;
    return true;
  }

  // Chooses the contact of greatest merit, if any exceeds `threshold`.
  template <class Merit>
  void pick(const Merit& merit, float threshold) {
    std::optional<std::size_t> best;
    float bestMerit = threshold;
    for (std::size_t i = 0; i < cluster_.size(); ++i) {
      const float m = merit(cluster_[i]);
      if (m > bestMerit && isSeparated(cluster_[i])) {
        best = i;
        bestMerit = m;
      }
    }
    if (best) choice_.index[choice_.count++] = *best;
  }

  void pickFarthest() {
    const Vec3 p = chosen(0);
    pick([&](const Contact& c) { return share(c) * lengthSq(c.position - p) * (c.isInManifold ? kAreaBonus : 1); }, 0);
  }

  void pickLargestTriangle() {
    const Vec3 p = chosen(0), q = chosen(1);
    const auto areaSq = [&](const Contact& c) {
      return lengthSq(cross(c.position - p, q - p)) * (c.isInManifold ? kAreaBonus * kAreaBonus : 1);
    };
    // A triangle thinner than the separation adds nothing that resists tipping.
    const float sliver = separationSq_ * lengthSq(p - q);
    pick([&](const Contact& c) { return areaSq(c) > sliver ? share(c) * share(c) * areaSq(c) : 0; }, 0);
  }

  // The area that a point adds beyond the triangle's edges, seen along the triangle's normal.
  void pickLargestGain() {
    const std::array<Vec3, 3> corner{chosen(0), chosen(1), chosen(2)};
    const Vec3 normal = normalized(cross(corner[1] - corner[0], corner[2] - corner[0]));
    const auto gain = [&](const Contact& c) {
      float outside = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& from = corner[k];
        outside = std::max(outside, dot(cross(c.position - from, corner[(k + 1) % 3] - from), normal));
      }
      return outside * (c.isInManifold ? kAreaBonus : 1);
    };
    pick([&](const Contact& c) { return gain(c) > separationSq_ ? share(c) * gain(c) : 0; }, 0);
  }

  std::span<const Contact> cluster_;
  float separationSq_;
  float maxSeparation_;
  ContactChoice choice_;
};

std::span<Contact> moveToFront(std::span<Contact> cluster, ContactChoice choice) {
  for (std::size_t k = 0; k < choice.count; ++k) {
    const std::size_t from = std::exchange(choice.index[k], k);
    std::swap(cluster[k], cluster[from]);
    // The contact that stood at k is now at `from`.
    std::replace(choice.index.begin() + static_cast<std::ptrdiff_t>(k) + 1, choice.index.end(), k, from);
  }
  return cluster.first(choice.count);
}

}  // namespace

std::span<Contact> chooseContacts(std::span<Contact> cluster, std::span<const ContactId> held, float separation,
                                  float maxSeparation) {
  if (cluster.empty()) return {};
  for (Contact& c : cluster) c.isInManifold = std::find(held.begin(), held.end(), c.id) != held.end();
  return moveToFront(cluster, Chooser(cluster, separation, maxSeparation).run());
}

}  // namespace cairn::bullet
