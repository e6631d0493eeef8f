// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/interrupted_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cairn/core/round_robin.h"
#include "scenes/truth/placed_body.h"

namespace cairn::accuracy_cost {
namespace {

/// Number of a frame's contacts that are checked at each interruption.
constexpr std::uint64_t kChecked = 32;
/// The uncertainty of poses and spheres in single precision, as a fraction of body size.
constexpr double kRounding = 1e-5;

/// The middle of the intersection of two balls, on the line through their centres. Where rounding separates them, it is
/// the middle between them.
Vec3d middleOf(const Vec3d& a, double radiusA, const Vec3d& b, double radiusB) {
  const double apart = distance(a, b);
  if (apart == 0) return a;
  const double from = std::max(-radiusA, apart - radiusB), to = std::min(radiusA, apart + radiusB);
  return a + (b - a) * ((from + to) / (2 * apart));
}

}  // namespace

InterruptedFrame::InterruptedFrame(const scenes::Model& model) : model_(model) {
  const MassProperties& mass = model.tree->mass();
  const Mat3d turn = transpose(mass.principalAxes);
  bodyFromTree_ = {turn, turn * ((model.tree->origin() - mass.centerOfMass) * model.scale), model.scale};
}

std::vector<Interrupted> InterruptedFrame::interrupt(std::span<const scenes::BodyMotion> motions,
                                                     std::span<const std::uint64_t> operations,
                                                     const scenes::FrameTruth* truth) {
  place(motions);
  findPairs();
  std::vector<Interrupted> found;
  for (const std::uint64_t limit : operations) {
    // A resolved traversal stays unchanged, whatever more is allowed.
    if (!found.empty() && found.back().isResolved) {
      found.push_back(found.back());
      continue;
    }
    found.push_back(run(limit));
    addErrors(found.back());
    if (truth) check(*truth, found.back());
  }
  return found;
}

void InterruptedFrame::place(std::span<const scenes::BodyMotion> motions) {
  poses_.clear();
  for (const scenes::BodyMotion& motion : motions) {
    const scenes::Placement body = scenes::placementOf(motion.pose);
    poses_.push_back({body.rotation * bodyFromTree_.rotation, body * bodyFromTree_.translation, bodyFromTree_.scale});
  }
}

void InterruptedFrame::findPairs() {
  overlapping_ = 0;
  for (int i = 0; i < static_cast<int>(poses_.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(poses_.size()); ++j) {
      if (overlapping_ == pairs_.size()) pairs_.emplace_back();
      BodyPair& pair = pairs_[overlapping_];
      pair.first = i;
      pair.second = j;
      pair.traversal.start(*model_.tree, *model_.tree, poses_[static_cast<std::size_t>(i)],
                           poses_[static_cast<std::size_t>(j)], 0);
      if (!pair.traversal.done() || !pair.traversal.leafPairs().empty()) ++overlapping_;
    }
}

Interrupted InterruptedFrame::run(std::uint64_t operations) {
  scheduled_.clear();
  for (std::size_t i = 0; i < overlapping_; ++i) {
    BodyPair& pair = pairs_[i];
    pair.traversal.start(*model_.tree, *model_.tree, poses_[static_cast<std::size_t>(pair.first)],
                         poses_[static_cast<std::size_t>(pair.second)], 0);
    scheduled_.push_back({.id = i, .traversal = &pair.traversal, .size = static_cast<float>(model_.size)});
  }
  Budget budget = Budget::operations(operations);
  RoundRobin roundRobin;
  Interrupted found;
  found.isResolved = Scheduler().run(scheduled_, roundRobin, budget) == Progress::done;
  found.operations = budget.used();
  return found;
}

template <class Visit>
void InterruptedFrame::forEachAnswer(const Visit& visit) const {
  for (const BodyPair& pair : std::span(pairs_).first(overlapping_))
    for (const auto pairs : {pair.traversal.front(), pair.traversal.leafPairs()})
      for (const NodePair& nodes : pairs)
        if (pair.traversal.mayTouch(nodes)) visit(pair, nodes);
}

void InterruptedFrame::addErrors(Interrupted& found) const {
  double sum = 0, squares = 0;
  const BodyPair* last = nullptr;
  found.best = INFINITY;
  forEachAnswer([&](const BodyPair& pair, const NodePair& nodes) {
    const double error = static_cast<double>(pair.traversal.pairError(nodes)) / model_.size;
    found.worst = std::max(found.worst, error);
    found.best = std::min(found.best, error);
    sum += error;
    squares += error * error;
    ++found.spherePairs;
    if (std::exchange(last, &pair) != &pair) ++found.bodyPairs;
  });
  if (found.spherePairs == 0) found.best = 0;
  const auto count = static_cast<double>(std::max<std::uint64_t>(found.spherePairs, 1));
  found.mean = sum / count;
  found.rms = std::sqrt(squares / count);
}

void InterruptedFrame::check(const scenes::FrameTruth& truth, Interrupted& found) const {
  ContactTruth& answer = found.truth;
  const std::uint64_t stride = found.spherePairs / kChecked + 1;
  std::uint64_t number = 0;
  std::vector<scenes::BodyPair> reported;
  forEachAnswer([&](const BodyPair& pair, const NodePair& nodes) {
    const scenes::BodyPair bodies(pair.first, pair.second);
    if (reported.empty() || reported.back() != bodies) reported.push_back(bodies);
    if (number++ % stride != 0) return;
    const double apart = separation(truth, pair, nodes) / model_.size;
    const double certified = static_cast<double>(pair.traversal.pairError(nodes)) / model_.size;
    ++answer.checked;
    answer.separationSum += apart;
    answer.worstSeparation = std::max(answer.worstSeparation, apart);
    if (apart > certified + kRounding) ++answer.beyondCertificate;
  });
  answer.meeting = static_cast<std::uint32_t>(truth.meeting().size());
  for (const scenes::BodyPair& pair : truth.meeting())
    if (!std::ranges::binary_search(reported, pair)) ++answer.missed;
  for (const scenes::BodyPair& pair : reported)
    if (!truth.meets(pair)) ++answer.invented;
}

double InterruptedFrame::separation(const scenes::FrameTruth& truth, const BodyPair& pair,
                                    const NodePair& nodes) const {
  const Sphere a = model_.tree->sphere(nodes.a), b = model_.tree->sphere(nodes.b);
  const Vec3d contact = middleOf(
      poses_[static_cast<std::size_t>(pair.first)] * Vec3d(a.center), static_cast<double>(a.radius) * model_.scale,
      poses_[static_cast<std::size_t>(pair.second)] * Vec3d(b.center), static_cast<double>(b.radius) * model_.scale);
  return truth.distanceFromSolid(pair.first, contact) + truth.distanceFromSolid(pair.second, contact);
}

}  // namespace cairn::accuracy_cost
