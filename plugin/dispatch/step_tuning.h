// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>

namespace cairn::bullet::step_tuning {

// Every number by which a step shares its time and operations. None of them changes what a contact is.

/// Of the operations that a whole pair took, by so much the expectation for others moves towards it: some sixteen pairs
/// are remembered. Without, plans go by what was guessed at first (`Budget_GoldenHash` changes).
inline constexpr double kLearning = 1.0 / 16;
/// Of what a step has left after holding, so much goes to pairs that have nothing to say, before any pair gets all. At
/// 0.9 towers fall asleep late (`Sleep.IsNotOnGuardsThatCarry`); at 0 flying bodies err by their whole size
/// (`CoarseLook.LeavesNoFlyingPairToTheSpheresOfWholeBodies`, `ErrsLessTheMoreItIsGiven`).
inline constexpr double kCoarseShare = 0.4;

/// Of so many steps in a row in which there is too little for all, a pair with an answer looks in one at what else came
/// near; in the others at what it touches.
inline constexpr std::uint64_t kStepsOfThrift = 4;
/// So many steps in a row may serve no pair that can be held, where time is short: without a turn now and then none
/// would ever be finished.
inline constexpr std::uint32_t kMaxStepsWithoutTurn = 7;
/// Operations that are given however short the time: two turns, some three microseconds with contacts.
inline constexpr std::uint64_t kMinOperations = 160;

/// What measuring a held pair's finds takes, as a part of a step: from there on it is measured as it is found. Held
/// back from refinement, it would leave the next steps nothing to refine with
/// (`HeldPairs.ThatCostMoreThanAStepHasComeToAnAnswer`).
inline constexpr double kLargeShareOfStep = 0.75;
/// Nanoseconds an operation, of a pair that is held, until it is known better: 150 nanoseconds a pair.
inline constexpr double kCarryOverCost = 5;
/// Pairs that are held between two looks at the clock: more end a step later, fewer spend it on looking.
inline constexpr std::size_t kCarriedBetweenClockLooks = 8;

/// Nanoseconds an operation of pairs that are brought up to date, until these are known better, and a pair's own share
/// in operations: 1 to 2 microseconds beside 5 to 10 nanoseconds an operation. With a smaller share, what many small
/// pairs take makes large ones look as if they never fit.
inline constexpr double kUpdateCost = 20, kUpdateWeight = 200;
/// Nanoseconds an operation that meshes take, a pair's own share in operations, and what a first question takes. As on
/// a machine of 2 GHz, for meshes of 1500 triangles, until they are known better.
inline constexpr double kMeshCost = 20, kMeshWeight = 200, kFirstMeshOperations = 2000;
/// Of what meshes are expected to take, so much is taken off in each step in which there was too little time to ask:
/// by half in twelve seconds (`MeshTime.IsHopedToBeLessWhereNothingIsAsked`).
inline constexpr double kHope = 0.001;

/// Steps in which each pair is looked at once, whether it rests: memory is given back after four to nine seconds. In a
/// world of 10,000 bodies at rest that takes some twenty microseconds a step (`RestingPairs.KeepNoMoreThanTheyUse`
/// fails without).
inline constexpr std::size_t kStepsToLookAtAll = 256;

// How many pairs ahead what one needs is fetched: about as many as are worked on while memory answers. Time alone.

/// In Bullet's pass: what tells whether anything has to be done, and what is copied.
inline constexpr std::size_t kSubjectsAhead = 8, kCopiesAhead = 4;
inline constexpr std::size_t kNamesAhead = 8;                                         ///< as pairs are put in order
inline constexpr std::size_t kStatesAhead = 3, kListsAhead = 2, kLeafPairsAhead = 1;  ///< as they are begun
inline constexpr std::size_t kCarriedAhead = 5, kCarriedBodiesAhead = 3, kCarriedPointsAhead = 2;  ///< as they are held
inline constexpr std::size_t kIdleAhead = 2;  ///< as they are made, often many at a time

}  // namespace cairn::bullet::step_tuning
