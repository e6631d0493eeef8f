// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/effects/effect.h"

namespace cairn::effects {

/// A blow acts where and when bodies touch first. Within a step a fast body sinks in, or is seen to come, by as far as
/// it moves: many of its corners are told at once that touch one after the other. All together they hold its spin, and
/// friction takes what it should have turned into spin: the more, the longer the step.
///
/// So of a pair that closes fast, contacts that touch later than the first have no say until the next step, what is
/// about to touch touches, and acts at the arm it will have then. What closes slower than a blow is left as it is. So
/// is what has sunk in by more than its radius, of which no corner can be told to have come first. Only where an effect
/// asks for it, see `Contact::ordersBlow`, and between bodies one of which has a volume.
class BlowOrder {
 public:
  /// Of the body's radius: what touches no farther apart than this touches together. A twentieth: of 80 rocks down a
  /// cliff, half or twice as much leaves the mean speed 5 % off at 5 ms, or nearly so.
  static constexpr btScalar kTogetherRadii = btScalar(0.05);

  /// Before the solver, when effects have changed the contacts.
  void arrange(std::span<Contact> contacts, const Step& step);
  /// After it: contacts are where they were and as far apart.
  void restore();

 private:
  struct First {
    btScalar sinceTouch = 0;  // s, negative: ahead
    bool isKnown = false, isAsked = false;
    bool isDeep = false;  // deeper than a radius: which of its corners came first is not to be told any more
  };
  struct Changed {
    btManifoldPoint* point;
    btScalar distance;
    btVector3 onA, onB;
  };

  void note(const Contact& contact);
  void findFirst(std::span<const Contact> contacts);
  void actLater(Contact& contact);
  void actAtTouch(Contact& contact, const Step& step);
  void remember(const Contact& contact);

  std::vector<First> firsts_;  // by impact
  std::vector<Changed> changed_;
};

}  // namespace cairn::effects
