// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/effects/effect.h"

namespace cairn::effects {

/// A blow acts where and when bodies touch first. Within one step a fast body sinks in as far as it moves, and contacts
/// are reported together for corners that touch one after another. Solved together, they stop the body's spin, and
/// friction takes speed that should become spin. The error grows with the step.
///
/// So in a pair that closes fast, contacts that touch later than the first have no say until the next step. Contacts
/// that are about to touch act at the arm they will have then. Pairs that close slower than a blow stay unchanged. So
/// do pairs that overlap by more than a radius, because the first corner is unknown. This applies only where an effect
/// asks for it, see `Contact::ordersBlow`, and only if one of the bodies has a volume.
class BlowOrder {
 public:
  /// Of the body's radius: what touches no farther apart than this touches together. A twentieth: of 80 rocks down a
  /// cliff, half or twice as much leaves the mean speed 5 % off at 5 ms, or nearly so.
  static constexpr btScalar kTogetherRadii = btScalar(0.05);
  /// Contacts slower than this fraction of the pair's fastest closing speed have no order. A corner about which the
  /// body turns hardly moves, so its depth over its speed does not show when it touched.
  static constexpr btScalar kSlowestPart = btScalar(0.25);

  /// Before the solver, when effects have changed the contacts.
  void arrange(std::span<Contact> contacts, const Step& step);
  /// After it: contacts are where they were and as far apart.
  void restore();

 private:
  struct First {
    btScalar fastest = 0;     // m/s, greatest closing speed of the pair's contacts
    btScalar sinceTouch = 0;  // s, negative: ahead
    bool isKnown = false, isAsked = false;
    bool isDeep = false;  // deeper than a radius, so that the first corner is unknown
  };
  struct Changed {
    btManifoldPoint* point;
    btScalar distance;
    btVector3 onA, onB;
  };

  First& firstOf(const Contact& contact);
  bool isInOrder(const Contact& contact);
  void note(const Contact& contact);
  void findFirst(std::span<const Contact> contacts);
  void actLater(Contact& contact);
  void actAtTouch(Contact& contact, const Step& step);
  void remember(const Contact& contact);

  std::vector<First> firsts_;  // by impact
  std::vector<Changed> changed_;
};

}  // namespace cairn::effects
