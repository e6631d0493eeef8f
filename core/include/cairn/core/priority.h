// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "cairn/core/export.h"

#include "cairn/core/traversal.h"
#include "cairn/core/viewer.h"

namespace cairn {

/// One pair of bodies in a step's narrow phase, and what is known of it without a viewer.
struct ScheduledPair {
  std::uint64_t id = 0;            ///< stable over steps and unique within one; breaks ties, never an address
  Traversal* traversal = nullptr;  ///< not owned
  Vec3d center{};                  ///< of the smaller body, world frame: where the pair is seen
  float size = 1;                  ///< of the smaller body, its box's diagonal, world length, > 0
  float closingSpeed = 0;          ///< bound on how fast the surfaces approach, world length per second, >= 0
  /// Reduced mass, m0 m1 / (m0 + m1): that of the other where one cannot be moved, 0 where neither can.
  float mass = 0;
  /// World length: how wrong the pair's answer may be until its traversal is done, however far that has come, because
  /// the last one no longer counts. 0: no worse than its front.
  float unansweredError = 0;
};

/// Decides which unfinished pair is refined next. A policy gets the pairs of a step, hands out turns, and learns how
/// each turn ended. The same calls must give the same answers on every run. Cairn's policies let no pair starve, and
/// allocate nothing once they have seen as many pairs.
class CAIRN_CORE_EXPORT Priority {
 public:
  virtual ~Priority() = default;
  /// A new step: `pairs` ascend by id and live until the step ends. Finished traversals may be among them.
  virtual void begin(std::span<const ScheduledPair> pairs) = 0;
  /// Index of the pair to refine for one turn, or nothing when every pair is done. Asked again before `turnEnded`, the
  /// answer is the same.
  virtual std::optional<std::size_t> next() = 0;
  /// How the turn that `next` gave out ended.
  virtual void turnEnded(std::size_t pair, Progress progress) = 0;
  /// How much it matters that this pair is brought up to date where a step has too little for all, >= 0: its square
  /// root counts times how wrong the pair's answer is, as a fraction of its size, and how long it has waited. 1 for
  /// policies that do not care. Asked before `begin`, for pairs not yet begun too: `traversal` is null,
  /// `unansweredError` 0.
  virtual double importance(const ScheduledPair& /*pair*/) const { return 1; }
  /// Whether `importance` is to be asked at all. False saves describing every pair of a step that has too little.
  virtual bool hasImportances() const { return true; }
  /// Who looks at the scene from the next step on; nothing: nobody. Policies that do not care ignore it.
  /// Precondition: `checkViewer` accepts it.
  virtual void setViewer(const std::optional<Viewer>& /*viewer*/) {}
};

}  // namespace cairn
